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
      damping_(common_damping(model)),
      safety_(safety),
      growth_(bounds_need_state(model) ? courant_growth : 1.0) {}

std::vector<double> CourantSteps::operator()(const std::vector<double>& omega) {
  const double fastest = growth_ * (omega.empty() ? 0.0 : *std::ranges::max_element(omega));
  if (damping_ > 0 && !(0.8 * fastest_ <= fastest && fastest <= fastest_)) {
    limits_.clear();
    fastest_ = fastest;
  }
  std::vector<double> steps;
  for (const double bound : omega) {
    const double w = growth_ * bound;
    if (w == 0) {
      steps.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const int octave = damping_ > 0 ? static_cast<int>(std::floor(std::log2(fastest_ / w))) : 0;
    const double upper =
        damping_ > 0 ? std::ldexp(fastest_, -octave) : w;  // without damping every w has the same limit
    auto [known, is_new] = limits_.try_emplace(octave, 0.0);
    if (is_new) {
      known->second = courant_limit(law_, velocity_, upper, damping_);
      require_courant(safety_, known->second);
    }
    steps.push_back(safety_ * known->second / upper);
  }
  return steps;
}

std::vector<double> courant_steps_of_particles(const Model<double>& model, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety) {
  require_bounded(model);
  return CourantSteps(model, law, velocity, safety)(frequency_bounds(model));
}

std::vector<double> courant_steps_of_particles(const Model<double>& model, const State<double>& state,
                                               const TruncationLaw& law, VelocitySeries velocity,
                                               double safety) {
  return CourantSteps(model, law, velocity, safety)(frequency_bounds(model, state));
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
  FrequencyMeter meter;
  TruncationLaw law;
  VelocitySeries velocity;
  double damping, safety;
  int refresh;
  int left = 0;                 // steps until the next bound
  std::uint64_t taken = 0;      // bounds so far
  double omega = 0, limit = 0;  // for which the limit is known, 0: not yet

  /// The longest step for frequencies up to w. With damping it takes long to find: one for higher frequencies serves for
  /// those somewhat below.
  double longest(double w) {
    if (damping == 0 ? limit == 0 : !(0.8 * omega <= w && w <= omega)) {
      omega = w;
      limit = courant_limit(law, velocity, omega, damping);
      require_courant(safety, limit);
    }
    return safety * limit / (damping == 0 ? w : omega);
  }
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
  OfStates of_states{FrequencyMeter(model), law, velocity, common_damping(model), safety, refresh};
  if (bounds_need_state(model)) {
    if (of_states.damping == 0) of_states.longest(1.0);  // refuses what is unstable
    require_courant(safety, 1.0);
    of_states_ = std::make_unique<OfStates>(std::move(of_states));
  } else if (const double omega = frequency_bound(model); omega > 0) {
    largest_step_ = of_states.longest(omega);
    frequency_.bound = omega;
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
    const double omega = of_states_->meter({series.time(), series.position(0), series.velocity(0)});
    if (std::isfinite(omega)) {
      largest_step_ = omega > 0 ? of_states_->longest(courant_growth * omega) : unlimited;
      frequency_ = {omega, frequency_.refreshed + (of_states_->taken++ > 0)};
    }
  }
  return std::min(inner_->propose(prospect), largest_step_);
}

}  // namespace jetlag
