// SPDX-License-Identifier: MIT
#pragma once
// Sine and cosine: two coupled rules, each reads the other's older coefficients.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// s = sin(u), c = cos(u):   s_0 = sin(u_0),   k s_k = sum_{j=1..k} j u_j c_{k-j}.         Source: s' = u' c.
/// Operands: u, c.   Range: all reals.
struct Sin {
  static constexpr const char* name = "sin";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& c, const auto&) {
    using std::sin;
    return k == 0 ? sin(u[0]) : integral_of_product(k, u, c);
  }
};

/// s = sin(u), c = cos(u):   c_0 = cos(u_0),   k c_k = -sum_{j=1..k} j u_j s_{k-j}.         Source: c' = -u' s.
/// Operands: u, s.   Range: all reals.
struct Cos {
  static constexpr const char* name = "cos";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& s, const auto&) {
    using std::cos;
    return k == 0 ? cos(u[0]) : -integral_of_product(k, u, s);
  }
};

}  // namespace jetlag
