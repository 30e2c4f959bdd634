// SPDX-License-Identifier: MIT
// The step from the last two coefficients: what it is, and the question whether a given step is short enough.

#include "jetlag/control/last_two.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/random.hpp"

namespace jetlag::testing {
namespace {

TEST(LastTwo, IsSevenTenthsOfTheStepAtWhichTheLargerOfTheLastTermsReachesTheTolerance) {
  // x = a (t / r)^k: a (h / r)^k = tolerance at h = r (tolerance / a)^{1/k}.
  const double a = 3, r = 0.5, tolerance = 1e-6;
  const auto c = [&](int k) { return a / std::pow(r, k); };
  const double expected = 0.7 * r * std::pow(tolerance / a, 1.0 / 7);  // order 7 is reached before order 8
  EXPECT_NEAR(last_two_step({8, {c(2), c(3)}, {c(7), c(8)}}, tolerance), expected, 1e-14 * expected);
}

TEST(LastTwo, AllowsStepsUpToItsOwnAndNoLongerOnes) {
  // Away from the threshold, by 1e-9 of it, rounding does not matter: logarithms of sizes up to 1e100 have 230 as their
  // largest value and an error of 230 eps, and a power of degree 20 of the step one of 20 eps.
  Uniform uniform(7);
  const auto size = [&] { return std::exp(uniform(-60, 60)); };
  for (int degree : {2, 3, 4, 5, 8, 20})
    for (int trial = 0; trial < 300; ++trial) {
      const LastTwoSizes sizes{degree,
                               {trial % 7 == 0 ? 0.0 : size(), trial % 5 == 0 ? 0.0 : size()},
                               {size(), trial % 3 == 0 ? 0.0 : size()}};
      const double tolerance = std::exp(uniform(-30, 0)), h = last_two_step(sizes, tolerance);
      if (degree > 2 && std::isinf(h)) continue;
      EXPECT_TRUE(LastTwoAllows(degree, tolerance, h * (1 - 1e-9))(sizes)) << degree << " " << trial;
      EXPECT_FALSE(LastTwoAllows(degree, tolerance, h * (1 + 1e-9))(sizes)) << degree << " " << trial;
    }
}

TEST(LastTwo, IsNotMisledByPowersBeyondTheRangeOfADouble) {
  // c_40 = 1e300 and a tolerance of 1e-9 ask for 0.7 * 10^(-309/40) = 1.3e-8; at h = 1e-9 the power h^40 is zero, and
  // so it would be at 1e-8, where the term is 1e-20, and at 3e-8, where it is 1.2e-1.
  const LastTwoSizes sizes{40, {1e300, 1e300}, {0, 1e300}};
  for (double h : {1e-9, 1e-8}) EXPECT_TRUE(LastTwoAllows(40, 1e-9, h)(sizes)) << h;
  EXPECT_FALSE(LastTwoAllows(40, 1e-9, 3e-8)(sizes));
  // No last terms: every step, however long.
  EXPECT_TRUE(LastTwoAllows(40, 1e-9, 1e30)({40, {1, 1}, {0, 0}}));
  EXPECT_FALSE(LastTwoAllows(8, 1e-9, 1.0)({8, {1, 1}, {std::numeric_limits<double>::quiet_NaN(), 0}}));
}

TEST(LastTwo, HasOthersToStandInWhereTheyVanish) {
  // 0.7 times the step at which term k - 1 or k reaches the tolerance, k the last order above N/2 that does not vanish.
  const double tolerance = 1e-6;
  const auto stood_in = [](std::vector<double> c) {
    const int degree = static_cast<int>(c.size()) - 1;
    LastTwoSizes sizes{degree, {c[2], c[3]}, {c[degree - 1], c[degree]}};
    stand_in(sizes, [&](int k) { return c[k]; });
    return sizes;
  };
  const LastTwoSizes sizes = stood_in({1, 1, 1, 1, 1, 32, 64, 0, 0});
  EXPECT_EQ(sizes.degree, 6);
  const double h = 0.7 * std::min(std::pow(tolerance / 32, 0.2), std::pow(tolerance / 64, 1.0 / 6));
  EXPECT_NEAR(last_two_step(sizes, tolerance), h, 1e-14);
  EXPECT_TRUE(LastTwoAllows(8, tolerance, h * (1 - 1e-9))(sizes));
  EXPECT_FALSE(LastTwoAllows(8, tolerance, h * (1 + 1e-9))(sizes));
  EXPECT_EQ(stood_in({1, 1, 1, 1, 1, 0, 0, 0, 0}).degree, 8);  // has ended in its first half
  EXPECT_TRUE(std::isinf(last_two_step(stood_in({1, 1, 1, 1, 1, 0, 0, 0, 0}), tolerance)));
}

}  // namespace
}  // namespace jetlag::testing
