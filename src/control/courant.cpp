// SPDX-License-Identifier: MIT
#include "jetlag/control/courant.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

/// The parameters of element e.
const double* parameters_of(const Elements<double>& elements, std::size_t e) {
  return elements.parameters.data() + e * elements.law.parameters.size();
}

}  // namespace

std::vector<double> frequency_bounds(const System<double>& system) {
  std::vector<double> load(system.particles(), 0.0);  // sum of stiffness / mass at a particle
  const auto inverse_mass = [&](int i) { return system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]; };
  const auto for_each_stiff = [&](auto use) {
    for (const auto& elements : system.elements()) {
      const auto& law = elements.law;
      if (law.stiffness == nullptr) continue;
      for (std::size_t e = 0; e < elements.count(); ++e)
        use(&elements.particles[e * law.participants], law.participants,
            law.stiffness(parameters_of(elements, e)));
    }
  };
  for_each_stiff([&](const int* p, int participants, double k) {
    for (int i = 0; i < participants; ++i) load[p[i]] += k * inverse_mass(p[i]);
  });
  std::vector<double> bound(system.particles(), 0.0);
  for_each_stiff([&](const int* p, int participants, double) {
    double sum = 0;
    for (int i = 0; i < participants; ++i) sum += load[p[i]];
    for (int i = 0; i < participants; ++i) bound[p[i]] = std::max(bound[p[i]], sum);
  });
  for (double& b : bound) b = std::sqrt(b);
  return bound;
}

double frequency_bound(const System<double>& system) {
  const auto bounds = frequency_bounds(system);
  return bounds.empty() ? 0.0 : *std::ranges::max_element(bounds);
}

std::string unbounded_force(const System<double>& system) {
  for (const auto& elements : system.elements())
    if (elements.count() > 0 && elements.law.stiffness == nullptr &&
        reads(elements.law, Input::Kind::position))
      return elements.law.name;
  return {};
}

void require_bounded(const System<double>& system) {
  if (const std::string force = unbounded_force(system); !force.empty())
    throw std::invalid_argument("courant: no stiffness is known of " + force +
                                ", so that nothing bounds the step; leave courant out");
}

double common_damping(const System<double>& system) {
  std::vector<double> rate(system.particles(), 0.0);
  for (const auto& elements : system.elements())
    if (elements.law.damping != nullptr)
      for (std::size_t e = 0; e < elements.count(); ++e) {
        const int i = elements.particles[e];
        rate[i] += elements.law.damping(parameters_of(elements, e)) / system.mass()[i];
      }
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) {
      least = std::min(least, rate[i]);
      most = std::max(most, rate[i]);
    }
  return least > 0 && most <= least * (1 + 1e-12) ? least : 0.0;
}

double courant_limit(const TruncationLaw& law, VelocitySeries velocity, double omega, double damping) {
  return omega * band_stability_limit(law, velocity, {omega, damping});
}

std::vector<double> courant_steps_of_particles(const System<double>& system, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety) {
  require_bounded(system);
  const double damping = common_damping(system);
  const std::vector<double> omega = frequency_bounds(system);
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
