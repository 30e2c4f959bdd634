// SPDX-License-Identifier: MIT
#pragma once
// Area functions.

#include <cmath>

#include "jetlag/series/functions/inverse.hpp"

namespace jetlag {

/// v = asinh(u), c = sqrt(1 + u^2):   v_0 = asinh(u_0),   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = u'.   Operands: u, c.   Range: all reals.
struct Asinh {
  static constexpr const char* name = "asinh";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::asinh;
    return k == 0 ? asinh(u[0]) : inverse_coefficient(k, u, c, v);
  }
};

/// v = acosh(u), c = sqrt(u^2 - 1):   v_0 = acosh(u_0),   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = u'.   Operands: u, c, which is sqrt(u - 1) sqrt(u + 1): u^2 would overflow, and u^2 - 1 is nearly
/// the square of a large u, whose double root costs 0.4 k^2 eps.
/// Range: u_0 > 1. At 1 coefficient 1 is the first that is not finite.
struct Acosh {
  static constexpr const char* name = "acosh";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::acosh;
    return k == 0 ? acosh(u[0]) : inverse_coefficient(k, u, c, v);
  }
};

/// v = atanh(u), c = 1 - u^2:   v_0 = atanh(u_0),   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.
/// Source: c v' = u'.   Operands: u, c.   Range: |u_0| < 1. At +-1 coefficient 0 is not finite.
struct Atanh {
  static constexpr const char* name = "atanh";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& c, const auto& v) {
    using std::atanh;
    return k == 0 ? atanh(u[0]) : inverse_coefficient(k, u, c, v);
  }
};

}  // namespace jetlag
