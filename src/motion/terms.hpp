// SPDX-License-Identifier: MIT
#pragma once
// What is asked of the series of observables, here and there.

#include <cmath>
#include <limits>
#include <vector>

namespace jetlag {

inline int sign(double x) { return (x > 0) - (x < 0); }

/// Two values of g that are computed in different ways, where the terms of its series add up to `size`: cancellation in g may
/// take half of the digits.
constexpr double same_value = 0x1p-30;

/// |c_k| h^k, and their sum.
struct Terms {
  Terms(const std::vector<double>& c, double h) {
    term.reserve(c.size());
    double power = 1;
    for (const double x : c) {
      term.push_back(std::abs(x) * power);
      sum += term.back();
      power *= h;
    }
  }
  /// Whether the last two are below rounding; two, because one may vanish by symmetry.
  bool converge() const {
    const std::size_t n = term.size() - 1;
    return n == 0 || term[n] + term[n - 1] <= std::numeric_limits<double>::epsilon() * sum;
  }
  std::vector<double> term;
  double sum = 0;
};

}  // namespace jetlag
