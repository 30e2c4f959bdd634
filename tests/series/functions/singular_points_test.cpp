// SPDX-License-Identifier: MIT
// Where a function is not analytic, the first coefficient that does not exist is not finite.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/series/comparisons.hpp"

namespace jetlag::testing::singular_points_test {
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
  EXPECT_LE(first_not_finite(pow(t, 1.5)), 2);  // coefficients 0 and 1 are 0, the next does not exist
  for (int k = 0; k < first_not_finite(pow(t, 1.5)); ++k) EXPECT_EQ(pow(t, 1.5)[k], 0.0);
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

TEST(SingularPoint, CbrtAtZeroHasItsValueOnly) {
  EXPECT_EQ(first_not_finite(cbrt(t)), 1);
  EXPECT_EQ(cbrt(t)[0], 0.0);
}

TEST(SingularPoint, LogarithmsAtTheEndOfTheirRangeHaveNoValue) {
  for (const double x : {0.0, -1.0}) {
    EXPECT_EQ(first_not_finite(log2(x + t)), 0);
    EXPECT_EQ(first_not_finite(log10(x + t)), 0);
    EXPECT_EQ(first_not_finite(log1p((x - 1.0) + t)), 0);
  }
}

TEST(SingularPoint,
     RootLikeFunctionsHaveTheirValueOnly) {  // asin(1 - t) = pi/2 - sqrt(2t) + ..., acosh(1 + t) = sqrt(2t)
  for (const double x : {1.0, -1.0}) {
    EXPECT_EQ(first_not_finite(asin(x + t)), 1);
    EXPECT_EQ(first_not_finite(acos(x + t)), 1);
    EXPECT_EQ(asin(x + t)[0], std::asin(x));
    EXPECT_EQ(acos(x + t)[0], std::acos(x));
  }
  EXPECT_EQ(first_not_finite(acosh(1.0 + t)), 1);
  EXPECT_EQ(acosh(1.0 + t)[0], 0.0);
}

TEST(SingularPoint, InverseFunctionsBeyondTheirRangeHaveNoValue) {
  for (const double x : {2.0, -2.0}) {
    EXPECT_EQ(first_not_finite(asin(x + t)), 0);
    EXPECT_EQ(first_not_finite(acos(x + t)), 0);
    EXPECT_EQ(first_not_finite(atanh(x + t)), 0);
    EXPECT_EQ(first_not_finite(acosh(x / 4 + t)), 0);
  }
  EXPECT_EQ(first_not_finite(atanh(1.0 + t)), 0);
  EXPECT_EQ(first_not_finite(atanh(-1.0 + t)), 0);
}

TEST(SingularPoint, PolarCoordinatesAtTheOrigin) {  // the length is that for t >= 0, the angle has no value
  EXPECT_TRUE(isfinite(hypot(t, t)));
  EXPECT_EQ(hypot(t, 0.0), t);
  EXPECT_EQ(hypot(-t, 0.0), t);
  EXPECT_EQ(hypot(t, t)[0], 0.0);
  EXPECT_EQ(first_not_finite(atan2(t, t)), 0);
  EXPECT_EQ(first_not_finite(atan2(t, 0.0)), 0);
  EXPECT_EQ(first_not_finite(atan2(0.0, t)), 0);
}

TEST(SingularPoint, PowerOfAMovingExponent) {
  EXPECT_EQ(first_not_finite(pow(t, 1.0 + t)), 1);  // t log(t) appears
  EXPECT_EQ(pow(t, 1.0 + t)[0], 0.0);
  EXPECT_LE(first_not_finite(pow(J(-2.0), 1.0 + t)), 1);
  EXPECT_EQ(first_not_finite(pow(0.0, t - 1.0)), 0);
}

TEST(SingularPoint, AbsAtItsKinkIsThatOfOneSide) {
  EXPECT_EQ(abs(t), t);
  EXPECT_EQ(max(t, -t), t);
  EXPECT_EQ(min(t, -t), -t);
}

TEST(SingularPoint, StretchesThatAddUpToZeroHaveTheirSumOnly) {  // 1, 1/2, -1/2 + t, one by one
  const J x = 1.0, y = 0.5, z = t - 0.5;
  const auto [a, b] =
      stretch_invariants(J(x * x + y * y + z * z), J(x * x * y * y + (x * x + y * y) * z * z), J(x * y * z));
  EXPECT_EQ(first_not_finite(a), 1);
  EXPECT_NEAR(a[0], 1.0, 1e-7);  // a double root, to half of the digits
  EXPECT_EQ(first_not_finite(b), 0);
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
  EXPECT_EQ(first_not_finite(tan(atanh(1.0 + t))), 0);
  EXPECT_EQ(first_not_finite(erf(asin(1.0 - t))), 1);
  EXPECT_EQ(first_not_finite(atan2(cbrt(t), 1.0)), 1);
}

}  // namespace
}  // namespace jetlag::testing::singular_points_test
