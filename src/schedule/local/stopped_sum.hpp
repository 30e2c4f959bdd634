// SPDX-License-Identifier: MIT
#pragma once
// The series of a particle that is stopped, at a time.

namespace jetlag {

/// x = sum_{n<=K} w_n x_n s^n,   v = sum_{n<=K} w_n (n+1) x_{n+1} s^n, or the derivative of x;   by Horner's rule.
/// c: shape (orders, stride), stride the padded dimension. own: of the velocity (truncation/velocity_series.hpp). v may be null.
template <int stride>
inline void stopped_sum(const double* c, int degree, const double* weights, bool own, double s, double* x,
                        double* v) {
  double sum[stride] = {}, slope[stride] = {};
  for (int n = degree; n >= 0; --n)
    for (int d = 0; d < stride; ++d) sum[d] = sum[d] * s + weights[n] * c[n * stride + d];
  const int dimension = stride < 4 ? stride : 3;
  for (int d = 0; d < dimension; ++d) x[d] = sum[d];
  if (!v) return;
  for (int n = own ? degree : degree - 1; n >= 0; --n)
    for (int d = 0; d < stride; ++d)
      slope[d] = slope[d] * s + weights[own ? n : n + 1] * ((n + 1) * c[(n + 1) * stride + d]);
  for (int d = 0; d < dimension; ++d) v[d] = slope[d];
}

}  // namespace jetlag
