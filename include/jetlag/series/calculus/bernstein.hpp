// SPDX-License-Identifier: MIT
#pragma once
// Polynomials in the Bernstein basis of an interval: p = sum_i b_i C(N,i) u^i (1-u)^(N-i), u from 0 to 1. The polynomial lies
// between the smallest and the largest b_i, b_0 and b_N are its values at the ends, and halves of the interval come nearer
// to it. Several polynomials of one degree stand beside each other: b_i is a row of `width` numbers.

#include <cstddef>

namespace jetlag::detail {

/// From the coefficients of powers of u in rows 0 .. n, in place:  b_i = sum_{k<=i} C(i,k) / C(N,k) c_k, each c_k over its
/// binomial, then Pascal's triangle by N(N+1)/2 sums.   Rounding: (N+3) eps/2 sum_k |c_k|.
template <std::size_t width>
void to_bernstein(double* rows, std::size_t n) {
  double binomial = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    for (std::size_t j = 0; j < width; ++j) rows[k * width + j] /= binomial;
    binomial = binomial * static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  for (std::size_t first = 1; first <= n; ++first)
    for (std::size_t i = n; i >= first; --i)
      for (std::size_t j = 0; j < width; ++j) rows[i * width + j] += rows[(i - 1) * width + j];
}

/// The part before u goes to `before`, the part after it takes the place of the whole (de Casteljau): averages only, so that
/// nothing cancels that the polynomial does not cancel.   Rounding: N eps times the largest |b_i|, N eps/2 at u = 1/2.
template <std::size_t width>
void split_bernstein(double* rows, double* before, std::size_t n, double u) {
  for (std::size_t first = 0; first <= n; ++first) {
    for (std::size_t j = 0; j < width; ++j) before[first * width + j] = rows[j];
    const std::size_t end = (n - first) * width;
    for (std::size_t j = 0; j < end; ++j) rows[j] = (1 - u) * rows[j] + u * rows[j + width];
  }
}

}  // namespace jetlag::detail
