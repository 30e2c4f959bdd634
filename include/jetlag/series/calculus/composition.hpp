// SPDX-License-Identifier: MIT
#pragma once
// Series of series: u(v(t)), and the series that undoes another. For containers with size() and [], and for jets.

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

/// w = u(v), as many coefficients as v has, by Horner's rule on truncated series:   w <- w v + u_k,   k = N, ..., 0.
///   v_0 = 0:   right for the function behind u where u has as many coefficients as v: u_n enters from t^n on. In step
///              k only coefficients up to N - k are needed: N^3/6 products.
///   v_0 != 0:  right for the polynomial u, N^3/2 products. For the function behind u all coefficients lack the terms
///              u_n v^n, n > N: expand that function about v_0 and compose its series with v - v_0 instead.
template <class U, class V>
V compose(const U& outer, const V& inner) {
  const auto& u = coefficients_of(outer);
  const auto& v = coefficients_of(inner);
  using T = std::decay_t<decltype(v[0])>;
  V composed(inner);
  const std::size_t size = v.size();
  for (std::size_t k = 0; k < size; ++k) composed[k] = T(0);
  if (size == 0) return composed;
  const bool at_origin = v[0] == T(0);
  for (std::size_t n = at_origin ? std::min(u.size(), size) : u.size(); n-- > 0;) {
    const auto& w = coefficients_of(composed);
    for (std::size_t k = at_origin ? size - n : size;
         k-- > 0;)  // in place: coefficient k of w v reads w_0, ..., w_k
      composed[k] = convolution(static_cast<int>(k), 0, static_cast<int>(k), w, v);
    composed[0] = composed[0] + T(u[n]);
  }
  return composed;
}

/// w with u(w(t)) = t and w(u(t)) = t: the inverse series, of as many coefficients as u has.
///   n w_n = coefficient n - 1 of g^{-n},   g = u(t)/t         Source: Lagrange 1770; Knuth, TAOCP 2, 4.7.
/// Cost: N^3/3 products.   Throws std::invalid_argument unless u_0 = 0 and u_1 is neither 0 nor NaN. (Where u_0 != 0
/// remove it: w(t - u_0) undoes u.)
template <class S>
S revert(const S& series) {
  const auto& u = coefficients_of(series);
  using T = std::decay_t<decltype(u[0])>;
  const std::size_t size = u.size();
  if (size < 2)
    throw std::invalid_argument("revert: the series must have coefficients u_0 and u_1, got " +
                                std::to_string(size) + " coefficients");
  if (!(u[0] == T(0)))
    throw std::invalid_argument("revert: u_0 must be 0 (remove it first), got " + shown(u[0]));
  if (u[1] == T(0) || u[1] != u[1])
    throw std::invalid_argument("revert: u_1 must not be 0 (there is no inverse series), got " + shown(u[1]));
  S inverse(series), power(series);
  inverse[0] = T(0);
  T first(1);                               // (1/u_1)^n
  for (std::size_t n = 1; n < size; ++n) {  // p = g^{-n}, g = u_1 + u_2 t + ...
    first = first / u[1];
    power[0] = first;
    const auto& p = coefficients_of(power);
    for (std::size_t k = 1; k < n; ++k) {  // k g_0 p_k = -sum_{j=0..k-1} (n (k-j) + j) g_{k-j} p_j
      T sum(0);
      for (std::size_t j = 0; j < k; ++j)
        sum = multiply_add<T>(static_cast<int>(n * (k - j) + j) * u[k - j + 1], p[j], sum);
      power[k] = -sum / (static_cast<int>(k) * u[1]);
    }
    inverse[n] = p[n - 1] / static_cast<int>(n);
  }
  return inverse;
}

}  // namespace jetlag
