// SPDX-License-Identifier: MIT
// Formulas that do not cancel, at points where the obvious ones lose digits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jetlag/series/elementary.hpp"

namespace jetlag::testing::cancellation_test {
namespace {

constexpr int degree = 20;
using J = Jet<double, degree>;
constexpr double eps = std::numeric_limits<double>::epsilon();

// Each coefficient is made of k factors, all positive or all alternating, each with a handful of roundings: <= 4 k eps.

TEST(Pow, OfANegativeWholeNumberIsAProductOfReciprocals) {  // 2^-15 6^-k C(-15, k)
  const J v = pow(2.0 + J::variable(0.0) / 3, -15);         // 1/(2 + t/3)^15 would cancel
  double expected = 0x1p-15;
  for (int k = 0; k <= degree; ++k) {
    EXPECT_NEAR(v[k], expected, 4 * (k + 1) * eps * std::abs(expected)) << k;
    expected *= -(15.0 + k) / (k + 1) / 6;
  }
}

TEST(Acosh, OfALargeNumberIsItsLogarithm) {  // log(2u) + O(u^-2): (-1)^{k-1}/(3^k k) at u = x (1 + t/3)
  const double x = 1.7e72;
  J u(x);
  u[1] = x / 3;
  const J v = acosh(u);  // by the root of u^2 - 1: off by 0.4 k^2 eps
  for (int k = 1; k <= degree; ++k) {
    const double expected = (k % 2 ? 1 : -1) * std::pow(3.0, -k) / k;
    EXPECT_NEAR(v[k], expected, 4 * (k + 1) * eps * std::abs(expected)) << k;
  }
}

}  // namespace
}  // namespace jetlag::testing::cancellation_test
