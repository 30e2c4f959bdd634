// SPDX-License-Identifier: MIT
#pragma once
// Random series for identities.

#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/series/jet.hpp"
#include "support/random.hpp"
#include "support/running_error.hpp"

namespace jetlag::testing {

/// f(u) for series u with random coefficients about several points. |u_k| < point 2^-k / 2: analytic in |t| < 2.
template <class T, int N, class F>
void at_random_series(F f) {
  Uniform draw(20);
  for (const double point : {0.25, 1.0, 1.75, 6.5}) {
    Jet<RunningError<T>, N> u(point);
    for (int k = 1; k <= N; ++k) u[k] = draw(-1, 1) * std::ldexp(point, -k - 1);
    SCOPED_TRACE(point);
    f(u);
  }
}

}  // namespace jetlag::testing
