// SPDX-License-Identifier: MIT
#include "jetlag/control/courant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "control/laws_with.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

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

CourantSteps::CourantSteps(const Model<double>& model, const TruncationLaw& law, VelocitySeries velocity,
                           double safety)
    : law_(law),
      velocity_(velocity),
      least_(least_damping(model)),
      safety_(safety),
      growth_(bounds_need_state(model) ? courant_growth : 1.0),
      growth_of_damping_(damping_needs_state(model) ? courant_growth : 1.0) {
  const bool needs_state = damping_needs_state(model);
  if (velocity == VelocitySeries::derivative) {
    if (needs_state)
      throw std::invalid_argument(
          "courant: where forces other than drag act on velocities, steps are bounded for velocities of "
          "their "
          "own series only, not for those of the derivative");
    least_ = common_damping(model);
  } else if (needs_state || damping_bound(model) > least_ * (1 + 1e-12)) {
    rays_.emplace(law);
  }
}

std::vector<double> CourantSteps::operator()(const std::vector<double>& omega,
                                             const std::vector<double>& damping) {
  const double fastest = growth_ * (omega.empty() ? 0.0 : *std::ranges::max_element(omega));
  if (is_damped() && !(0.8 * fastest_ <= fastest && fastest <= fastest_)) {
    limits_.clear();
    fastest_ = fastest;
  }
  std::vector<double> steps;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double w = growth_ * omega[i];
    if (rays_) {
      steps.push_back(safety_ * rays_->step({w, least_, growth_of_damping_ * damping[i]}));
      require_courant(safety_, steps.back());
      continue;
    }
    if (w == 0) {
      steps.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const int octave = is_damped() ? static_cast<int>(std::floor(std::log2(fastest_ / w))) : 0;
    const double upper =
        is_damped() ? std::ldexp(fastest_, -octave) : w;  // without damping every w has the same limit
    auto [known, is_new] = limits_.try_emplace(octave, 0.0);
    if (is_new) {
      known->second = courant_limit(law_, velocity_, upper, least_);
      require_courant(safety_, known->second);
    }
    steps.push_back(safety_ * known->second / upper);
  }
  return steps;
}

void CourantSteps::require_stable() {
  require_courant(safety_, 1.0);
  if (!is_damped()) (*this)({1.0}, {0.0});
}

std::vector<double> courant_steps_of_particles(const Model<double>& model, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety) {
  require_bounded(model);
  return CourantSteps(model, law, velocity, safety)(frequency_bounds(model), damping_bounds(model));
}

std::vector<double> courant_steps_of_particles(const Model<double>& model, const State<double>& state,
                                               const TruncationLaw& law, VelocitySeries velocity,
                                               double safety) {
  require_finite_tangents(model, state);
  require_damping(model, state);
  return CourantSteps(model, law, velocity, safety)(FrequencyMeter(model).of_particles(state),
                                                    DampingMeter(model).of_particles(state));
}

double courant_step(const Model<double>& model, const State<double>& state, const TruncationLaw& law,
                    VelocitySeries velocity, double safety) {
  require_finite_tangents(model, state);
  require_damping(model, state);
  return CourantSteps(model, law, velocity, safety)({FrequencyMeter(model)(state)},
                                                    {DampingMeter(model)(state)})
      .front();
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

// ---- the control -----------------------------------------------------------------------------------------

namespace {
constexpr double unlimited = std::numeric_limits<double>::infinity();
}

struct Courant::OfStates {
  FrequencyMeter frequency;
  DampingMeter damping;
  CourantSteps steps;
  int refresh;
  int left = 0;             // steps until the next bounds
  std::uint64_t taken = 0;  // bounds so far
};

Courant::Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega)
    : inner_(std::move(inner)),
      largest_step_(omega > 0 ? safety * limit / omega : unlimited),
      frequency_{omega} {
  require_courant(safety, limit);
}

Courant::Courant(std::unique_ptr<Control> inner, double safety, const Model<double>& model,
                 const TruncationLaw& law, VelocitySeries velocity, int refresh)
    : inner_(std::move(inner)), largest_step_(unlimited) {
  if (refresh < 1)
    throw std::invalid_argument("courant_refresh must be >= 1, got " + std::to_string(refresh));
  CourantSteps steps(model, law, velocity, safety);
  if (bounds_need_state(model) || damping_needs_state(model)) {
    steps.require_stable();
    of_states_ = std::make_unique<OfStates>(
        OfStates{FrequencyMeter(model), DampingMeter(model), std::move(steps), refresh});
  } else if (const double omega = frequency_bound(model), damping = damping_bound(model);
             omega > 0 || damping > 0) {
    largest_step_ = steps({omega}, {damping}).front();
    if (omega > 0) frequency_.bound = omega;
  }
}

Courant::Courant(const Courant& other)
    : Control(other),
      inner_(other.inner_->clone()),
      largest_step_(other.largest_step_),
      frequency_(other.frequency_),
      of_states_(other.of_states_ ? std::make_unique<OfStates>(*other.of_states_) : nullptr) {}

Courant::~Courant() = default;

std::unique_ptr<Control> Courant::clone() const { return std::unique_ptr<Control>(new Courant(*this)); }

/// A bound that is not finite leaves the last one: the series is not finite either, and says so.
double Courant::propose(const Prospect& prospect) {
  if (of_states_ && of_states_->left-- == 0) {
    of_states_->left = of_states_->refresh - 1;
    const Expansion<double>& series = prospect.series;
    const State<double> state{series.time(), series.position(0), series.velocity(0)};
    const double omega = of_states_->frequency(state), damping = of_states_->damping(state);
    if (std::isfinite(omega) && std::isfinite(damping)) {
      if (of_states_->taken == 0) of_states_->damping.require_positive(state.time);
      largest_step_ = of_states_->steps({omega}, {damping}).front();
      frequency_ = {omega, frequency_.refreshed + (of_states_->taken++ > 0)};
    }
  }
  return std::min(inner_->propose(prospect), largest_step_);
}

}  // namespace jetlag
