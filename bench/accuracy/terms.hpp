// SPDX-License-Identifier: MIT
#pragma once
// S_k and C_k of measure.hpp: coefficient k if nothing cancelled, and with each term counted by its factors.

#include <algorithm>

#include "accuracy/functions.hpp"
#include "jetlag/series/calculus/composition.hpp"
#include "jetlag/series/elementary.hpp"

namespace jetlag::accuracy {

inline True exact(const Computed& u) {
  True v;
  for (int k = 0; k <= degree; ++k) v[k] = u[k];
  return v;
}

/// |u_0| + |u_1| t + ...
inline True sizes(const True& u) {
  True v;
  for (int k = 0; k <= True::degree; ++k) v[k] = u[k] < 0 ? Precise(-u[k]) : u[k];
  return v;
}

/// |u_1| t + |u_2| t^2 + ...
inline True rest(const True& u) {
  True v = sizes(u);
  v[0] = 0;
  return v;
}

/// Of what adds or chooses.
inline Terms no_terms() { return {True(0.0), True(0.0)}; }

/// Of u v: each term is a product of two given numbers.
inline Terms terms_of_product(const Computed& u, const Computed& v) {
  const True sum = sizes(exact(u)) * sizes(exact(v));
  return {sum, sum};
}

/// Of f(u):   S = sum_m a_m (|u_1| t + ...)^m,   C = sum_m m a_m (|u_1| t + ...)^m.
template <class F>
Terms terms_of_function(F f, const Computed& u) {
  const True g = sizes(f(True::variable(Precise(u[0]))));
  True a = g, weighted;
  for (int m = 2; m <= degree; ++m)
    for (int i = 1; i <= std::min(m / 2, neighbours); ++i)
      a[m] = std::max(a[m], Precise(sqrt(Precise(g[m - i] * g[m + i]))));
  for (int m = 1; m <= degree; ++m) weighted[m] = m * a[m];
  const True w = rest(exact(u));
  return {compose(a, w), compose(weighted, w)};
}

/// Of u / v:   |u|(t) times those of 1 / v.
inline Terms terms_of_quotient(const Computed& u, const Computed& v) {
  const Terms reciprocal = terms_of_function([](const auto& x) { return 1.0 / x; }, v);
  const True size = sizes(exact(u));
  return {size * reciprocal.sum, size * reciprocal.condition};
}

/// Of u^v = exp(w), w = v log(u):   S = |p_0| exp(w~),   C = S times the C of w,   w~: the S of w without w~_0.
inline Terms terms_of_power(const Computed& u, const Computed& v) {
  const Terms logarithm = terms_of_function([](const auto& x) { return log(x); }, u);
  const True size = sizes(exact(v));
  const True sum = pow(Precise(u[0]), Precise(v[0])) * exp(rest(size * logarithm.sum));
  return {sum, sum * rest(size * logarithm.condition + rest(size) * logarithm.sum)};
}

/// z~ = sum_{j>=1} (|x_j| + |y_j|) t^j / |z_0|.
inline True complex_rest(const Computed& x, const Computed& y) {
  return (rest(exact(x)) + rest(exact(y))) / Precise(hypot(Precise(x[0]), Precise(y[0])));
}

/// Of |z|:   S = |z_0| (2 - sqrt(1 - z~))^2,   C = z~ dS/dz~;   coefficient 1 from the gradient.
inline Terms terms_of_hypot(const Computed& x, const Computed& y) {
  const Precise r = hypot(Precise(x[0]), Precise(y[0]));
  const True z = complex_rest(x, y), root = sqrt(1.0 - z);
  Terms terms{r * square(2.0 - root), r * (2.0 - root) * z / root};
  terms.sum[1] = terms.condition[1] = Precise((abs(Precise(x[0]) * x[1]) + abs(Precise(y[0]) * y[1])) / r);
  return terms;
}

/// Of the angle of z:   S = -log(1 - z~),   C = z~ dS/dz~;   coefficients 0 and 1 from the angle and its gradient.
inline Terms terms_of_atan2(const Computed& y, const Computed& x) {
  const Precise r = hypot(Precise(x[0]), Precise(y[0]));
  const True z = complex_rest(x, y);
  Terms terms{-log(1.0 - z), z / (1.0 - z)};
  terms.sum[0] = abs(atan2(Precise(y[0]), Precise(x[0])));
  terms.sum[1] = terms.condition[1] =
      Precise((abs(Precise(x[0]) * y[1]) + abs(Precise(y[0]) * x[1])) / r / r);
  return terms;
}

}  // namespace jetlag::accuracy
