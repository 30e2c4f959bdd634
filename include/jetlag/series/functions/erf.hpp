// SPDX-License-Identifier: MIT
#pragma once
// Error functions, and the Gaussian that is their derivative.

#include <cmath>
#include <limits>

#include "jetlag/series/constants.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

/// exp(-x^2) to a few units in the last place, also where x^2 is large: its rounding error would be multiplied by it.
/// exp(-h^2) exp(-(x - h)(x + h)) with h = x rounded to half its digits, so that h^2 is exact (Veltkamp's split).
template <class T>
[[gnu::always_inline]] inline T exp_of_minus_square(const T& x) {
  using std::exp, std::ldexp;
  const T square = x * x;
  if constexpr (std::numeric_limits<T>::is_specialized && requires { ldexp(x, 1); }) {
    if (square < T(1 << 20)) {  // else 0 in all built-in types
      const T shifted = (ldexp(T(1), (std::numeric_limits<T>::digits + 1) / 2) + T(1)) * x;
      const T h = shifted - (shifted - x);
      return T(exp(T(-(h * h))) * exp(T(-((x - h) * (x + h)))));
    }
  }
  return T(exp(T(-square)));
}

/// g = exp(-u^2), s = u^2:   g_0 = exp(-u_0^2),   k g_k = -sum_{j=1..k} j s_j g_{k-j}.         Source: g' = -s' g.
/// Operands: u, s.   Range: all reals.
struct Gaussian {
  static constexpr const char* name = "gaussian";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& u, const auto& s, const auto& g) {
    return k == 0 ? exp_of_minus_square(u[0]) : -weighted_convolution(k, 1, k, s, g) / k;
  }
};

/// v = erf(u), g = exp(-u^2):   v_0 = erf(u_0),   k v_k = 2/sqrt(pi) sum_{j=1..k} j u_j g_{k-j}.
/// Source: DLMF 7.2.1 and the chain rule.   Operands: u, g.   Range: all reals.
struct Erf {
  static constexpr const char* name = "erf";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& g, const auto&) {
    using std::erf;
    using T = std::decay_t<decltype(u[0] * g[0])>;
    if (k == 0) return T(erf(u[0]));
    return T(Constants<T>::two_over_sqrt_pi() * weighted_convolution(k, 1, k, u, g) / k);
  }
};

/// v = erfc(u) = 1 - erf(u), g = exp(-u^2):   v_0 = erfc(u_0), which does not cancel,
/// k v_k = -2/sqrt(pi) sum_{j=1..k} j u_j g_{k-j}.   Operands: u, g.   Range: all reals.
struct Erfc {
  static constexpr const char* name = "erfc";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& g, const auto&) {
    using std::erfc;
    using T = std::decay_t<decltype(u[0] * g[0])>;
    if (k == 0) return T(erfc(u[0]));
    return T(-Constants<T>::two_over_sqrt_pi() * weighted_convolution(k, 1, k, u, g) / k);
  }
};

}  // namespace jetlag
