// SPDX-License-Identifier: MIT
#pragma once
// Area functions.

#include <cmath>

#include "jetlag/series/inverse.hpp"

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
/// Source: c v' = u'.   Operands: u, c.   Range: u_0 > 1. At 1 coefficient 1 is the first that is not finite.
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

/// l = sqrt(u_0^2 - 1), a number:   l_0 = sqrt(u_0 - 1) sqrt(u_0 + 1), which does not cancel or overflow,   l_k = 0.
/// The series sqrt(u^2 - 1) follows from it as hypot does from its length (polar.hpp).
struct HyperbolicLength {
  static constexpr const char* name = "hyperbolic length";
  static constexpr std::array reads{Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto&) {
    using std::sqrt;
    using T = std::decay_t<decltype(u[0] * u[0])>;
    return k == 0 ? T(sqrt(T(u[0] - T(1))) * sqrt(T(u[0] + T(1)))) : T(0);
  }
};

}  // namespace jetlag
