// SPDX-License-Identifier: MIT
#pragma once
// The Courant limit: no step beyond what is stable for the stiffest oscillation of a scene.

#include <string>
#include <vector>

#include "jetlag/control/control.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/truncation/stability.hpp"

namespace jetlag {

/// An upper bound of the fastest angular frequency [rad/s] that the elements with a stiffness k can have (forces/force.hpp):
///     omega^2 <= max over elements of  sum_{i of it} l_i,     l_i = sum_{elements at i} k / m_i.
/// For with A_i the root of an element's tangent from participant i, |A_i u|^2 <= k |u|^2,
///     |sum_i A_i x_i|^2 <= (sum_i l_i) sum_i |A_i x_i|^2 / l_i <= (sum_i l_i) k sum_i |x_i|^2 / l_i,
/// and the sum of k / l_i over the elements at i is m_i. Fixed particles count as infinitely heavy. 0 when no law of the
/// system has a stiffness. What the others do, such as gravity, is not bounded: see require_bounded.
double frequency_bound(const Model<double>& model);

/// The same for each particle, over the elements that it takes part in: how fast its neighbourhood may oscillate [rad/s].
/// Shape (particles).
std::vector<double> frequency_bounds(const Model<double>& model);

/// The name of the first force that acts on positions and has no stiffness: frequency_bound goes without it. Empty if there
/// is none.
std::string unbounded_force(const Model<double>& model);

/// Throws std::invalid_argument naming such a force, unless it says itself that it is `unbounded`, as gravity does: then no
/// fraction of frequency_bound is known to be a safe step.
void require_bounded(const Model<double>& model);

/// The rate c / m [1/s] at which laws with a damping c slow every particle that is not fixed, if it is the same for all of
/// them: then each oscillation is q'' = -omega^2 q - (c/m) q'. Otherwise 0, on the safe side.
double common_damping(const Model<double>& model);

/// The Courant limit omega h [1]: how long a step may be for all oscillations of frequencies up to omega [rad/s] and of
/// this damping [1/s] to be stable in mean square. 0 where there is none, as for degree 6 without damping.
double courant_limit(const TruncationLaw& law, VelocitySeries velocity, double omega, double damping);

/// Throws std::invalid_argument unless safety is in (0, 1] and limit > 0.
void require_courant(double safety, double limit);

/// safety * limit / omega for each particle by its own bound of the frequency, infinity where it has none [s]: for clocks of
/// their own. It presumes that a neighbourhood oscillates as if all of it took such steps. Shape (particles).
/// Throws std::invalid_argument as require_courant and require_bounded.
std::vector<double> courant_steps_of_particles(const Model<double>& model, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety);

/// Another control, cropped at  safety * limit / omega.
class Courant final : public Control {
 public:
  /// limit: see courant_limit (2 for leapfrog). safety: in (0, 1]. Throws std::invalid_argument, also for a limit of 0.
  Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega);
  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return inner_->orders_read(law, velocity);
  }
  double propose(const Prospect& prospect) override {
    return std::min(inner_->propose(prospect), largest_step_);
  }
  bool is_given() const override { return inner_->is_given(); }
  double past_kinks() const override { return inner_->past_kinks(); }
  std::unique_ptr<Control> clone() const override {
    return std::unique_ptr<Control>(new Courant(inner_->clone(), largest_step_));
  }

 private:
  Courant(std::unique_ptr<Control> inner, double largest_step)
      : inner_(std::move(inner)), largest_step_(largest_step) {}

  std::unique_ptr<Control> inner_;
  double largest_step_;
};

}  // namespace jetlag
