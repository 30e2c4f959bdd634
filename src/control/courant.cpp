// SPDX-License-Identifier: MIT
#include "jetlag/control/courant.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

/// f(particles, value) for each element whose law has this function of its parameters.
template <class F>
void for_each_with(const Model<double>& model, RecordedLaw::OfParameters RecordedLaw::* function, F use) {
  for (const auto& law : model.laws()) {
    const auto& [recorded, particles, parameters] = law->elements();
    if (recorded.*function == nullptr) continue;
    for (const int e : law->all())
      use(law->particles_of(e), (recorded.*function)(parameters.data() + e * recorded.parameters.size()));
  }
}

}  // namespace

std::vector<double> frequency_bounds(const Model<double>& model) {
  std::vector<double> load(model.particles(), 0.0);  // sum of stiffness / mass at a particle
  for_each_with(model, &RecordedLaw::stiffness, [&](auto particles, double k) {
    for (const int i : particles) load[i] += k * model.inverse_mass(i);
  });
  std::vector<double> bound(model.particles(), 0.0);
  for_each_with(model, &RecordedLaw::stiffness, [&](auto particles, double) {
    double sum = 0;
    for (const int i : particles) sum += load[i];
    for (const int i : particles) bound[i] = std::max(bound[i], sum);
  });
  for (double& b : bound) b = std::sqrt(b);
  return bound;
}

double frequency_bound(const Model<double>& model) {
  const auto bounds = frequency_bounds(model);
  return bounds.empty() ? 0.0 : *std::ranges::max_element(bounds);
}

namespace {

/// The first law that acts on positions, has no stiffness, and of which `which` is true; null if there is none.
template <class F>
const RecordedLaw* first_without_stiffness(const Model<double>& model, F which) {
  for (const auto& law : model.laws()) {
    const RecordedLaw& recorded = law->elements().law;
    if (law->count() > 0 && recorded.stiffness == nullptr && reads(recorded, Input::Kind::position) &&
        which(recorded))
      return &recorded;
  }
  return nullptr;
}

}  // namespace

std::string unbounded_force(const Model<double>& model) {
  const RecordedLaw* law = first_without_stiffness(model, [](const auto&) { return true; });
  return law == nullptr ? "" : law->name;
}

void require_bounded(const Model<double>& model) {
  if (const auto* law = first_without_stiffness(model, [](const auto& of) { return !of.unbounded; }))
    throw std::invalid_argument("courant: no stiffness is known of " + law->name +
                                ", so that nothing bounds the step; leave courant out");
}

double common_damping(const Model<double>& model) {
  std::vector<double> rate(model.particles(), 0.0);
  for_each_with(model, &RecordedLaw::damping,
                [&](auto particles, double c) { rate[particles[0]] += c / model.mass()[particles[0]]; });
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < model.particles(); ++i)
    if (!model.is_fixed(i)) {
      least = std::min(least, rate[i]);
      most = std::max(most, rate[i]);
    }
  return least > 0 && most <= least * (1 + 1e-12) ? least : 0.0;
}

double courant_limit(const TruncationLaw& law, VelocitySeries velocity, double omega, double damping) {
  return omega * band_stability_limit(law, velocity, {omega, damping});
}

std::vector<double> courant_steps_of_particles(const Model<double>& model, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety) {
  require_bounded(model);
  const double damping = common_damping(model);
  const std::vector<double> omega = frequency_bounds(model);
  const double fastest = omega.empty() ? 0.0 : *std::ranges::max_element(omega);
  std::map<int, double> limits;  // by octave below the fastest
  std::vector<double> steps;
  for (const double w : omega) {
    if (w == 0) {
      steps.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const int octave = damping > 0 ? static_cast<int>(std::floor(std::log2(fastest / w))) : 0;
    const double upper =
        damping > 0 ? std::ldexp(fastest, -octave) : w;  // without damping every w has the same limit
    auto [known, is_new] = limits.try_emplace(octave, 0.0);
    if (is_new) {
      known->second = courant_limit(law, velocity, upper, damping);
      require_courant(safety, known->second);
    }
    steps.push_back(safety * known->second / upper);
  }
  return steps;
}

void require_courant(double safety, double limit) {
  if (!(safety > 0.0 && safety <= 1.0))
    throw std::invalid_argument("courant must be in (0, 1], got " + shown(safety));
  if (!(limit > 0.0))
    throw std::invalid_argument(
        "courant: this truncation is unstable for undamped oscillations at every step; add drag, or take "
        "degree 3, 4, "
        "7, 8, 11, 12, ... or, for a random degree, a min_degree of at least half of such a max_degree, and "
        "velocities of "
        "their own series");
}

Courant::Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega)
    : inner_(std::move(inner)),
      largest_step_(omega > 0 ? safety * limit / omega : std::numeric_limits<double>::infinity()) {
  require_courant(safety, limit);
}

}  // namespace jetlag
