// SPDX-License-Identifier: MIT
// Where a function is not analytic, the first coefficient that does not exist is not finite.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/series/elementary.hpp"

namespace jetlag::testing {
namespace {

using J = Jet<double, 4>;
const J t = J::variable(0.0);

/// The order of the first coefficient that is not finite; 5 if there is none.
int first_not_finite(const J& u) {
  for (int k = 0; k <= J::degree; ++k)
    if (!std::isfinite(u[k])) return k;
  return J::degree + 1;
}

TEST(SingularPoint, SqrtAtZeroHasItsValueOnly) {
  EXPECT_EQ(first_not_finite(sqrt(t)), 1);
  EXPECT_EQ(sqrt(t)[0], 0.0);
}

TEST(SingularPoint, SqrtBelowZeroHasNoValue) { EXPECT_EQ(first_not_finite(sqrt(t - 1.0)), 0); }

TEST(SingularPoint, RealPowerAtZeroHasItsValueOnly) {
  EXPECT_EQ(first_not_finite(pow(t, 0.5)), 1);
  EXPECT_EQ(pow(t, 0.5)[0], 0.0);
  EXPECT_EQ(first_not_finite(pow(t, -0.5)), 0);
}

TEST(SingularPoint, LogAtZeroHasNoValue) {
  EXPECT_EQ(first_not_finite(log(t)), 0);
  EXPECT_EQ(first_not_finite(log(t - 1.0)), 0);
}

TEST(SingularPoint, ReciprocalOfTHasNoValue) {
  EXPECT_EQ(first_not_finite(1.0 / t), 0);
  EXPECT_EQ(first_not_finite(J(1.0) / t), 0);
  EXPECT_EQ(first_not_finite(pow(t, -2)), 0);
  EXPECT_EQ(first_not_finite(t / (t * t)), 0);  // a pole remains after cancellation
}

TEST(SingularPoint, QuotientByZeroHasNoValue) {
  EXPECT_EQ(first_not_finite(t / 0.0), 0);
  EXPECT_EQ(first_not_finite(t / J(0.0)), 0);
}

TEST(SingularPoint, RemovableSingularityLosesTheTopCoefficients) {  // as many as the power that is cancelled
  EXPECT_EQ(first_not_finite(t / t), 4);
  EXPECT_EQ((t / t)[0], 1.0);
  EXPECT_EQ(first_not_finite(t * t / (t * t)), 3);
  EXPECT_EQ(first_not_finite(sin(t) / t), 4);
  EXPECT_EQ((sin(t) / t)[2], -1.0 / 6.0);
}

TEST(SingularPoint, WhatIsComputedFromAMissingCoefficientIsMissing) {
  EXPECT_EQ(first_not_finite(exp(sqrt(t))), 1);
  EXPECT_EQ(first_not_finite(sqrt(t) * sqrt(t)), 1);
  EXPECT_EQ(first_not_finite(cos(1.0 / t)), 0);
  EXPECT_EQ(first_not_finite(1.0 + t * log(t)), 0);
}

}  // namespace
}  // namespace jetlag::testing
