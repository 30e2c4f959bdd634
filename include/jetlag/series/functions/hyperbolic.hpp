// SPDX-License-Identifier: MIT
#pragma once
// Hyperbolic functions: sinh with cosh, and tanh with its derivative, read each other's older coefficients.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// s = sinh(u), c = cosh(u):   s_0 = sinh(u_0),   k s_k = sum_{j=1..k} j u_j c_{k-j}.         Source: s' = u' c.
/// Operands: u, c.   Range: all reals.
struct Sinh {
  static constexpr const char* name = "sinh";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& c, const auto&) {
    using std::sinh;
    return k == 0 ? sinh(u[0]) : integral_of_product(k, u, c);
  }
};

/// s = sinh(u), c = cosh(u):   c_0 = cosh(u_0),   k c_k = sum_{j=1..k} j u_j s_{k-j}.         Source: c' = u' s.
/// Operands: u, s.   Range: all reals.
struct Cosh {
  static constexpr const char* name = "cosh";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& s, const auto&) {
    using std::cosh;
    return k == 0 ? cosh(u[0]) : integral_of_product(k, u, s);
  }
};

/// t = tanh(u), c = 1 - t^2:   t_0 = tanh(u_0),   k t_k = sum_{j=1..k} j u_j c_{k-j}.         Source: t' = u' c.
/// Operands: u, c.   Range: all reals.
struct Tanh {
  static constexpr const char* name = "tanh";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& c, const auto&) {
    using std::tanh;
    return k == 0 ? tanh(u[0]) : integral_of_product(k, u, c);
  }
};

/// t = tanh(u), c = 1 - t^2 = 1 / cosh(u)^2:   c_0 = 1 / cosh(u_0)^2 (1 - t_0^2 would cancel),   c_k = -(t^2)_k.
/// Operands: u, t.
struct HyperbolicSecantSquared {
  static constexpr const char* name = "hyperbolic secant squared";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& t, const auto&) {
    using std::cosh;
    using T = std::decay_t<decltype(t[0] * t[0])>;
    if (k > 0) return T(-symmetric_convolution(k, 0, t));
    const T secant = T(1) / cosh(u[0]);
    return T(secant * secant);
  }
};

}  // namespace jetlag
