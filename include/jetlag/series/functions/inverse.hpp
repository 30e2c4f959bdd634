// SPDX-License-Identifier: MIT
#pragma once
// What the inverse functions share: each has an algebraic derivative.

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// Coefficient k >= 1 of v:   v_k = (u_k - (1/k) sum_{j=1..k-1} j v_j c_{k-j}) / c_0.         Source: c v' = u'.
auto inverse_coefficient(int k, const auto& u, const auto& c, const auto& v) {
  return (u[k] - weighted_convolution(k, 1, k - 1, v, c) / k) / c[0];
}

/// w = 1 - u^2:   w_0 = (1 - u_0)(1 + u_0), which does not cancel,   w_k = -(u^2)_k.
struct OneMinusSquare {
  static constexpr const char* name = "one minus square";
  static constexpr std::array reads{Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto&) {
    using T = std::decay_t<decltype(u[0] * u[0])>;
    return k == 0 ? T((T(1) - u[0]) * (T(1) + u[0])) : T(-symmetric_convolution(k, 0, u));
  }
};

}  // namespace jetlag
