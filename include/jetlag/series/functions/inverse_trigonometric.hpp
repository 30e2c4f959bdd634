// SPDX-License-Identifier: MIT
#pragma once
// Arcus functions of one argument. atan2 is in polar.hpp.

#include <cmath>

#include "jetlag/series/functions/inverse.hpp"

namespace jetlag {

/// v = asin(u), c = sqrt(1 - u^2):   v_0 = asin(u_0),   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = u'.   Operands: u, c.   Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
struct Asin {
  static constexpr const char* name = "asin";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::asin;
    return k == 0 ? asin(u[0]) : inverse_coefficient(k, u, c, v);
  }
};

/// v = acos(u), c = sqrt(1 - u^2):   v_0 = acos(u_0),   v_k = -(u_k + (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = -u'.   Operands: u, c.   Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
struct Acos {
  static constexpr const char* name = "acos";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::acos;
    return k == 0 ? acos(u[0]) : -(u[k] + weighted_convolution(k, 1, k - 1, v, c) / k) / c[0];
  }
};

/// v = atan(u), c = 1 + u^2:   v_0 = atan(u_0),   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = u'.   Operands: u, c.   Range: all reals.
struct Atan {
  static constexpr const char* name = "atan";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::atan;
    return k == 0 ? atan(u[0]) : inverse_coefficient(k, u, c, v);
  }
};

}  // namespace jetlag
