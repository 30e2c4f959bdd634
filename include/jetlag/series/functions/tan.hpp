// SPDX-License-Identifier: MIT
#pragma once
// Tangent, coupled with the square of the secant.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// t = tan(u), c = 1 + t^2:   t_0 = tan(u_0),   k t_k = sum_{j=1..k} j u_j c_{k-j}.         Source: t' = u' c.
/// Operands: u, c.   Range: u_0 is no odd multiple of pi/2 (no floating-point number is).
struct Tan {
  static constexpr const char* name = "tan";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& c, const auto&) {
    using std::tan;
    return k == 0 ? tan(u[0]) : integral_of_product(k, u, c);
  }
};

/// t = tan(u), c = 1 + t^2 = 1 / cos(u)^2:   c_0 = 1 + t_0^2,   c_k = (t^2)_k.
/// Operands: u (not read), t.
struct SecantSquared {
  static constexpr const char* name = "secant squared";
  static constexpr std::array reads{Reads::nothing, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto&, const auto& t, const auto&) {
    using T = std::decay_t<decltype(t[0] * t[0])>;
    return k == 0 ? multiply_add<T>(t[0], t[0], T(1)) : symmetric_convolution(k, 0, t);
  }
};

}  // namespace jetlag
