// SPDX-License-Identifier: MIT
#include "jetlag/control/variance_target.hpp"

#include <cmath>

namespace jetlag {

VarianceTarget::VarianceTarget(double step, double max_step, double tolerance_random, double tolerance_bias)
    : step_(step), max_step_(max_step), tolerance_random_(tolerance_random), tolerance_bias_(tolerance_bias) {
  require_positive("step", step);
  require_positive("max_step", max_step, true);
  if (step > max_step) throw std::invalid_argument("step must not exceed max_step");
  require_positive("tolerance_random", tolerance_random);
  require_positive("tolerance_bias", tolerance_bias);
}

double VarianceTarget::factor(const Prospect& prospect, double h) const {
  const int m = prospect.law.min_degree(), n = prospect.law.max_degree();
  const double spread = std::sqrt(largest_position_variance(prospect, h));
  const double bias = largest_position_bias(prospect, h);
  const auto ratio = [](double tolerance, double error, int order) {
    return error == 0.0 ? std::numeric_limits<double>::infinity() : std::pow(tolerance / error, 1.0 / order);
  };
  return 0.9 * std::min(ratio(tolerance_random_, spread, m + 1), ratio(tolerance_bias_, bias, n));
}

double VarianceTarget::propose(const Prospect& prospect) {
  double f = factor(prospect, step_);
  if (f >= 0.9) return step_ = std::min(step_ * std::min(f, 2.0), max_step_);
  while (f < 0.9 && step_ > std::numeric_limits<double>::min()) {
    step_ *= std::max(f, 0.25);
    f = factor(prospect, step_);
  }
  return step_ = std::min(step_, max_step_);
}

}  // namespace jetlag
