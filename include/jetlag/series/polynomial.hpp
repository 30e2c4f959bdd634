// SPDX-License-Identifier: MIT
#pragma once
// Polynomials given by their coefficients c_0, c_1, ..., c_N in any container with size() and [].

#include <cstddef>

namespace jetlag {

/// c(t) = c_0 + t (c_1 + t (c_2 + ...)), by Horner's rule. X is the type of t and of the result.
template <class X, class C>
X evaluate(const C& c, const X& t) {
  std::size_t k = c.size();
  if (k == 0) return X(0);
  X sum(c[--k]);
  while (k > 0) sum = sum * t + c[--k];
  return sum;
}

/// c(t) becomes c(s + t), in place, by repeated synthetic division (Horner, Shaw-Traub): N(N+1)/2 products.
template <class C, class T>
void taylor_shift(C& c, const T& s) {
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t k = n - 1; k > i; --k) c[k - 1] = c[k - 1] + s * c[k];
}

}  // namespace jetlag
