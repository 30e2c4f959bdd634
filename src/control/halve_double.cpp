// SPDX-License-Identifier: MIT
#include "jetlag/control/halve_double.hpp"

#include <cmath>
#include <string>

#include "jetlag/base/text.hpp"

namespace jetlag {

HalveDouble::HalveDouble(double step, double max_step, double min_variance, double max_variance,
                         int min_degree)
    : step_(step), max_step_(max_step), min_variance_(min_variance), max_variance_(max_variance) {
  require_positive("step", step);
  require_positive("max_step", max_step, true);
  require_positive("min_variance", min_variance);
  require_positive("max_variance", max_variance);
  if (step > max_step) throw std::invalid_argument("step must not exceed max_step");
  const double ratio = std::pow(4.0, min_degree + 1);
  if (!(max_variance / min_variance > ratio))
    throw std::invalid_argument("max_variance / min_variance must exceed 4^(min_degree+1) = " + shown(ratio) +
                                ", or the step is halved and doubled for ever; got " +
                                shown(max_variance / min_variance));
}

double HalveDouble::propose(const Prospect& prospect) {
  const auto squared_error = [&](double h) {
    const double bias = largest_position_bias(prospect, h);
    return largest_position_variance(prospect, h) + bias * bias;
  };
  double error = squared_error(step_);
  if (error < min_variance_) {
    // Where the bias rules, it may grow by more than the thresholds' ratio: a step that would be halved is not taken.
    const double doubled = std::min(2.0 * step_, max_step_);
    if (squared_error(doubled) <= max_variance_) step_ = doubled;
  } else {
    while (error > max_variance_ && step_ > std::numeric_limits<double>::min()) {
      step_ *= 0.5;
      error = squared_error(step_);
    }
  }
  return step_;
}

}  // namespace jetlag
