// SPDX-License-Identifier: MIT
#pragma once
// Cube root.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// c = cbrt(f):   c_0 = cbrt(f_0),   3 k f_0 c_k = sum_{j=0..k-1} (k - 4j) f_{k-j} c_j.         Source: 3 f c' = f' c.
/// Range: f_0 != 0. At f_0 = 0 coefficient 1 is not finite.
struct Cbrt {
  static constexpr const char* name = "cbrt";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& c) {
    using std::cbrt;
    using T = std::decay_t<decltype(f[0] * c[0])>;
    if (k == 0) return T(cbrt(f[0]));
    T sum = (k * f[k]) * c[0];
    for (int j = 1; j < k; ++j) sum = multiply_add<T>((k - 4 * j) * f[k - j], c[j], sum);
    return T(sum / ((3 * k) * f[0]));
  }
};

}  // namespace jetlag
