// SPDX-License-Identifier: MIT
#pragma once
// What a sample of numbers amounts to.

#include <array>
#include <span>

namespace jetlag {

struct Sample {
  static constexpr std::array probabilities{0.05, 0.25, 0.5, 0.75, 0.95};

  double mean = 0;
  double spread = 0;  // sqrt(sum (x - mean)^2 / (n - 1)); NaN for one number
  std::array<double, probabilities.size()> quantiles{};  // at these probabilities
  double half_width = 0;  // of the 95 % confidence interval of the mean; NaN for one
};

/// Quantile p lies between the numbers x_(k), x_(k+1) in order, k = 1 + floor((n-1) p), by linear interpolation (type 7
/// of Hyndman and Fan 1996). The interval is mean +- student_95(n - 1) spread / sqrt n, right for normal numbers and,
/// where n is large, for others. All NaN where a number is not finite. The order of x is changed; n >= 1.
/// Throws std::invalid_argument for an empty sample.
Sample sample_of(std::span<double> x);

/// Quantile 0.975 of Student's distribution with `freedom` >= 1 degrees of freedom: to 1e-6 for one and two, else by the
/// expansion in 1/freedom about the normal one up to the fourth power, to 0.2 % for three and to 0.01 % from six on.
/// Source: Abramowitz, Stegun 26.7.5.   Throws std::invalid_argument.
double student_95(long freedom);

}  // namespace jetlag
