// SPDX-License-Identifier: MIT
#pragma once
// Steps up to kinks: whatever else chooses a step, it ends where the force of an element has a kink (model/kinks.hpp). This is
// the one place where something that lies within a step ends it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "jetlag/control/control.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/model/kinks.hpp"

namespace jetlag {

/// The steps of particles from one time on, and which of them are too long.
///
///     steps.begin();
///     for (..) steps.take({particle, h, curve}, now, x, v);
///     if (steps.any_late()) for (const Kinks::Step& shorter : steps.shortened(..)) ..
class StepsToKinks {
 public:
  /// No kinks.
  StepsToKinks() = default;
  /// Keeps no reference to the system.
  explicit StepsToKinks(const Model<double>& model) : kinks_(model) {}

  bool none() const { return kinks_.none(); }
  Kinks& kinks() { return kinks_; }
  const Kinks& kinks() const { return kinks_; }

  void begin() { late_.clear(); }
  /// See Kinks::take.
  void take(const Kinks::Step& step, double now, const double* x, const double* v) {
    if (!kinks_.take(step, now, x, v)) late_.push_back(step);
  }
  /// Whether some leave no room before kinks.
  bool any_late() const { return !late_.empty(); }
  std::span<const Kinks::Step> late() const { return late_; }

  /// Steps that must be shorter: late ones, and those of other particles that were to go farther in a step that has begun
  /// before. None becomes shorter than some places of the time, or it would not go on.
  /// depth [m] > 0: how far beyond a kink they may end. Near a kink that is a point they stay within an estimate of the radius
  /// of convergence of the series up to `degree`: norm(particle, k) is the size of coefficient k, times unit^k.
  template <class Norm>
  std::span<const Kinks::Step> shortened(double depth, const Paths& now, int degree, double unit,
                                         const Norm& norm);

  /// The shortest step from a time on [s].
  static double least(double now) { return 8 * std::numeric_limits<double>::epsilon() * std::abs(now); }

 private:
  Kinks kinks_;
  std::vector<Kinks::Step> late_, shortened_;
  std::vector<double> before_;  // the late steps as they came
};

/// Another control, whose steps end at kinks of forces where it chooses them and is not given them. The kinks are sought on
/// the series as far as that control has read it: where that is, does not depend on the degree that is drawn.
class ToKinks final : public Control {
 public:
  /// Keeps no reference to the system.
  ToKinks(const Model<double>& model, std::unique_ptr<Control> inner);
  ToKinks(const ToKinks& other);
  ToKinks(ToKinks&&) = default;

  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return inner_->orders_read(law, velocity);
  }
  /// Not longer than the limit.
  double propose(const Prospect& prospect) override;
  bool is_given() const override { return inner_->is_given(); }
  double past_kinks() const override { return inner_->past_kinks(); }
  double longest() const override { return inner_->longest(); }
  std::optional<CourantFrequency> courant_frequency() const override { return inner_->courant_frequency(); }
  std::unique_ptr<Control> clone() const override { return std::make_unique<ToKinks>(*this); }

  /// Whether there are kinks at which its steps end.
  bool seeks_kinks() const { return !steps_.none(); }

  /// The particles for whose kinks the step that was proposed last was shortened, ascending; none where it was not.
  const std::vector<int>& at_kinks() const { return at_kinks_; }

  /// The positions at the end of a step: what is known of the kinks holds for a step that begins there.
  void left_at(const Coordinates<double>& position) {
    if (!steps_.none()) left_at_ = position;
  }

  /// What it knows of a trajectory.
  struct Trajectory {
    std::unique_ptr<Control> control{};  // the other one
    std::vector<Kinks::Track> tracks{};  // of the particles, up to where it was left
    Coordinates<double> left_at{};
  };
  /// Goes on with another trajectory of the same system; `other` is then the one so far.
  void exchange(Trajectory& other);

 private:
  double up_to_kinks(double h, const Prospect& prospect);

  std::unique_ptr<Control> inner_;
  StepsToKinks steps_;  // none for steps that are given
  std::vector<bool> fixed_;
  std::vector<double> curve_;    // of the path of each particle [m]
  Coordinates<double> left_at_;  // positions that the kinks know of
  std::vector<int> at_kinks_;
};

template <class Norm>
std::span<const Kinks::Step> StepsToKinks::shortened(double depth, const Paths& now, int degree, double unit,
                                                     const Norm& norm) {
  before_.clear();
  for (const Kinks::Step& step : late_) before_.push_back(step.h);
  shortened_ = kinks_.shorten(late_, depth, now);
  for (std::size_t k = 0; k < late_.size(); ++k) {
    Kinks::Step& step = late_[k];
    if (step.near_point) {
      const double radius = step_within_radius(degree, [&](int order) { return norm(step.particle, order); });
      step.h = std::min(step.h, unit * radius);
    }
    if (step.h < before_[k]) shortened_.push_back(step);
  }
  for (Kinks::Step& step : shortened_) step.h = std::max(step.h, least(now.now()));
  return shortened_;
}

}  // namespace jetlag
