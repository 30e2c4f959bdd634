// SPDX-License-Identifier: MIT
#pragma once
// Natural logarithm.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// l = log(f):   l_0 = log(f_0),   l_k = (f_k - (1/k) sum_{j=1..k-1} j l_j f_{k-j}) / f_0.         Source: f l' = f'.
/// Range: f_0 > 0. At f_0 = 0 coefficient 0 is not finite.
struct Log {
  static constexpr const char* name = "log";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& l) {
    using std::log;
    if (k == 0) return log(f[0]);
    return (f[k] - weighted_convolution(k, 1, k - 1, l, f) / k) / f[0];
  }
};

}  // namespace jetlag
