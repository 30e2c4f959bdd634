// SPDX-License-Identifier: MIT
#pragma once
// Absolute value, minimum and maximum: a choice by the sign of a series, of u or of u - v.
//
// Right after t = 0 the sign of u is that of its first coefficient u_j that is not zero. For even j it is the same on both
// sides; for odd j |u| has a kink at 0, and the series is that of its right half, t >= 0: |t| = t, as sqrt(t^2) = t. Who
// goes to the left counts the time backwards.
//
//         j = 0            j = 1            j = 2
//      \                (\)     /         \      /
//       \__  |u|         (\)   /  |u|      \    /  |u|
//                         (\) /             '..'
//                          (\/

#include <limits>

#include "jetlag/series/conditions.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

/// 1, -1 or 0; NaN for what is none of these.
template <class T>
T sign_of(const T& x) {
  if (x > T(0)) return T(1);
  if (x < T(0)) return T(-1);
  return x == T(0) ? T(0) : T(std::numeric_limits<double>::quiet_NaN());
}

/// a where s <= 0, b where s > 0, NaN where s is NaN.
template <class T>
T by_sign(const T& s, const T& a, const T& b) {
  return s > T(0) ? b : s <= T(0) ? a : s;
}

/// s_k: the sign of u right after t = 0 as far as u_0 ... u_k tell: +-1, 0 while all are zero.
/// s_0 = sign(u_0);   s_k = s_{k-1} unless that is 0;   else sign(u_k).
struct Sign {
  static constexpr const char* name = "sign";
  static constexpr std::array reads{Reads::newest, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& s) {
    using T = std::decay_t<decltype(s[0])>;
    if (k == 0) return T(sign_of(u[0]));
    return T(where(s[k - 1], s[k - 1], sign_of(u[k])));
  }
};

/// w = |u| with s = sign of u:   w_k = s_k u_k.
/// Operands: s, u.
struct Abs {
  static constexpr const char* name = "abs";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& s, const auto& u, const auto&) { return s[k] * u[k]; }
};

/// w = min(a, b) with s = sign of a - b; with b, a for a, b it is the maximum:   w_k = a_k if s_k <= 0, else b_k.
/// Operands: s, a, b.
struct BySign {
  static constexpr const char* name = "by sign";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& s, const auto& a, const auto& b, const auto&) {
    return by_sign(s[k], a[k], b[k]);
  }
};

}  // namespace jetlag
