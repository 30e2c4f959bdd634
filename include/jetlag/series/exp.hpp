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
    return k == 0 ? exp(u[0]) : weighted_convolution(k, 1, k, u, v) / k;
  }
};

}  // namespace jetlag
