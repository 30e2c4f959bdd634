// SPDX-License-Identifier: MIT
#pragma once
// Choices: a comparison makes a condition (1 or 0), a condition selects one of two series.
//
// A jet is compared with an ordinary `if`; these rules are for tapes, where each lane decides for itself. What the
// functions of numbers below do with an `if`, SIMD lanes do with a mask (src/tape/lanes.hpp).

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// 1 where a < b, else 0; 0 for NaN.
template <class T>
T less(const T& a, const T& b) {
  return T(a < b ? 1 : 0);
}

/// 1 where a <= b, else 0; 0 for NaN.
template <class T>
T less_or_equal(const T& a, const T& b) {
  return T(a <= b ? 1 : 0);
}

/// a where c is not 0, else b.
template <class T>
T where(const T& c, const T& a, const T& b) {
  return c == T(0) ? b : a;
}

/// c = (u < v) at t = 0:   c_0 = 1 or 0,   c_k = 0.
struct Less {
  static constexpr const char* name = "less";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& v, const auto&) {
    using T = std::decay_t<decltype(u[0])>;
    return k == 0 ? less(u[0], v[0]) : T(0);
  }
};

/// c = (u <= v) at t = 0:   c_0 = 1 or 0,   c_k = 0.
struct LessOrEqual {
  static constexpr const char* name = "less or equal";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& v, const auto&) {
    using T = std::decay_t<decltype(u[0])>;
    return k == 0 ? less_or_equal(u[0], v[0]) : T(0);
  }
};

/// c = (a and b) of conditions:   c_0 = a_0 b_0,   c_k = 0.
struct And {
  static constexpr const char* name = "and";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& a, const auto& b, const auto&) {
    using T = std::decay_t<decltype(a[0])>;
    return k == 0 ? T(a[0] * b[0]) : T(0);
  }
};

/// c = (a or b) of conditions:   c_0 = a_0 + b_0 - a_0 b_0,   c_k = 0.
struct Or {
  static constexpr const char* name = "or";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& a, const auto& b, const auto&) {
    using T = std::decay_t<decltype(a[0])>;
    return k == 0 ? T(a[0] + b[0] - a[0] * b[0]) : T(0);
  }
};

/// c = (not a) of a condition:   c_0 = 1 - a_0,   c_k = 0.
struct Not {
  static constexpr const char* name = "not";
  static constexpr std::array reads{Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& a, const auto&) {
    using T = std::decay_t<decltype(a[0])>;
    return k == 0 ? T(T(1) - a[0]) : T(0);
  }
};

/// w = a if the condition c holds, else b:   w_k = a_k where c_0 is not 0, else b_k.
/// The branch that is not selected may be anything, NaN included.
struct Select {
  static constexpr const char* name = "select";
  static constexpr std::array reads{Reads::first, Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& c, const auto& a, const auto& b, const auto&) {
    return where(c[0], a[k], b[k]);
  }
};

}  // namespace jetlag
