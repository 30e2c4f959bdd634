// SPDX-License-Identifier: MIT
#pragma once
// Exponential.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// v = exp(u):   v_0 = exp(u_0),   k v_k = sum_{j=1..k} j u_j v_{k-j}.         Source: v' = u' v.
/// Range: all reals.
struct Exp {
  static constexpr const char* name = "exp";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& v) {
    using std::exp;
    return k == 0 ? exp(u[0]) : integral_of_product(k, u, v);
  }
};

/// v = exp(u) - 1 with e = exp(u):   v_0 = expm1(u_0),   v_k = e_k.
/// Operands: u, e.   Range: all reals.
struct Expm1 {
  static constexpr const char* name = "expm1";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& e, const auto&) {
    using std::expm1;
    return k == 0 ? expm1(u[0]) : e[k];
  }
};

}  // namespace jetlag
