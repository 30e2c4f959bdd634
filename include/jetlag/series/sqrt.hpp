// SPDX-License-Identifier: MIT
#pragma once
// Square root.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// s = sqrt(f):   s_0 = sqrt(f_0),   s_k = (f_k - sum_{j=1..k-1} s_j s_{k-j}) / (2 s_0).         Source: s^2 = f.
/// Range: f_0 > 0. At f_0 = 0 coefficient 1 is the first that is not finite.
struct Sqrt {
  static constexpr const char* name = "sqrt";
  static constexpr std::array reads{Reads::newest, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& s) {
    using std::sqrt;
    return k == 0 ? sqrt(f[0]) : (f[k] - symmetric_convolution(k, 1, s)) / (s[0] + s[0]);
  }
};

}  // namespace jetlag
