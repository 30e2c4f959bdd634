// SPDX-License-Identifier: MIT
#pragma once
// Polynomials given by their coefficients c_0, c_1, ..., c_N in any container with size() and [].

#include <cmath>
#include <concepts>
#include <cstddef>

#include "jetlag/base/error_free.hpp"

namespace jetlag {

/// The coefficients of a series: of a jet the container in it, of a container itself.
template <class S>
decltype(auto) coefficients_of(const S& u) {
  if constexpr (requires { u.coefficients(); })
    return u.coefficients();
  else
    return (u);
}

/// c(t) = c_0 + t (c_1 + t (c_2 + ...)), by Horner's rule. X is the type of t and of the result.
template <class X, class C>
X evaluate(const C& c, const X& t) {
  std::size_t k = c.size();
  if (k == 0) return X(0);
  X sum(c[--k]);
  while (k > 0) sum = sum * t + c[--k];
  return sum;
}

/// c(t) in two parts: high is Horner's value, bit for bit, low its error, found by the same rule from the rounding
/// errors of each product (p_k) and each sum (s_k):   low = sum_k (p_k + s_k) t^k.
/// Source: Graillat, Langlois, Louvet, Algorithms for accurate, validated and fast polynomial evaluation, JJIAM 26
/// (2009), algorithm 3.1, theorem 3.2:   |high + low - c(t)| <= g^2 sum_k |c_k| |t|^k,   g = 2N u / (1 - 2N u), u = eps/2.
/// Coefficients must be exact in X. Range: no underflow. Where high is not finite, low is 0.
template <std::floating_point X, class S>
TwoPart<X> evaluate_in_two_parts(const S& series, X t) {
  const auto& c = coefficients_of(series);
  std::size_t k = c.size();
  if (k == 0) return {};
  X value(c[--k]), error(0);
  while (k > 0) {
    const auto product = two_product(value, t);
    const auto sum = two_sum(product.high, X(c[--k]));
    value = sum.high;
    error = error * t + (product.low + sum.low);
  }
  return {value, std::isfinite(error) ? error : X(0)};
}

/// c(t) as if computed with twice the digits and then rounded, at 4 to 5 times the cost of Horner's rule:
///   |result - c(t)| <= u |c(t)| + g^2 sum_k |c_k| |t|^k         as above.
template <std::floating_point X, class S>
X evaluate_compensated(const S& series, X t) {
  return evaluate_in_two_parts(series, t).value();
}

/// c(t) becomes c(s + t), in place, by repeated synthetic division (Horner, Shaw-Traub): N(N+1)/2 products.
template <class C, class T>
void taylor_shift(C& c, const T& s) {
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t k = n - 1; k > i; --k) c[k - 1] = c[k - 1] + s * c[k];
}

}  // namespace jetlag
