// SPDX-License-Identifier: MIT
#pragma once
// The paper's control (algorithm 1), corrected.

#include "jetlag/control/control.hpp"

namespace jetlag {

/// The step is halved while the variance of a position exceeds max_variance, and doubled once, up to max_step,
/// when it is below min_variance.
///
/// Against the paper: doubling takes the smaller of 2 h and max_step (printed: the larger); the variance is that of
/// the step to be taken, so that nothing is rejected; the squared bias max(|c_N|, |c_{N-1}|)^2 is added to the
/// variance, so that the control still works where min = max degree and the variance vanishes; and since the
/// variance scales as h^{2(m+1)}, the thresholds must differ by more than the factor 4^{m+1}, or the step would be
/// halved and doubled for ever.
class HalveDouble final : public Control {
 public:
  /// step: the first one [s]; max_step >= step [s]; 0 < min_variance < max_variance [m^2].
  /// min_degree: m of the truncation law. Throws std::invalid_argument.
  HalveDouble(double step, double max_step, double min_variance, double max_variance, int min_degree);
  int orders_read(const TruncationLaw& law, VelocitySeries) const override { return orders_for_errors(law); }
  double propose(const Prospect& prospect) override;
  double past_kinks() const override { return std::sqrt(min_variance_); }
  double longest() const override { return max_step_; }
  std::unique_ptr<Control> clone() const override { return std::make_unique<HalveDouble>(*this); }

 private:
  double step_, max_step_, min_variance_, max_variance_;
};

}  // namespace jetlag
