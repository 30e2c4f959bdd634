// SPDX-License-Identifier: MIT
#pragma once
// The step at which randomness and bias meet their tolerances.

#include "jetlag/control/control.hpp"

namespace jetlag {

/// h_new = h clamp(0.9 min((tol_r / sqrt(Var))^{1/(m+1)}, (tol_b / bias)^{1/N}), 1/4, 2),   then at most max_step.
/// Var: largest variance of a position at step h; bias = max(|c_N h^N|, |c_{N-1} h^{N-1}|), the terms that bound what
/// is left out. Both are those of the step to be taken: the rule is repeated, while it shortens the step.
class VarianceTarget final : public Control {
 public:
  /// step: the first one [s]; tolerance_random, tolerance_bias: errors of a position in one step [m].
  VarianceTarget(double step, double max_step, double tolerance_random, double tolerance_bias);
  int orders_read(const TruncationLaw& law, VelocitySeries) const override { return orders_for_errors(law); }
  double propose(const Prospect& prospect) override;
  double past_kinks() const override { return std::min(tolerance_random_, tolerance_bias_); }
  double longest() const override { return max_step_; }
  std::unique_ptr<Control> clone() const override { return std::make_unique<VarianceTarget>(*this); }

 private:
  double factor(const Prospect& prospect, double h) const;
  double step_, max_step_, tolerance_random_, tolerance_bias_;
};

}  // namespace jetlag
