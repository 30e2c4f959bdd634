// SPDX-License-Identifier: MIT
// When a cubic leaves a band about zero.
#include "schedule/departure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "jetlag/truncation/draws.hpp"

namespace jetlag::testing::departure_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Departure, IsTheRootOfASinglePower) {
  EXPECT_DOUBLE_EQ(first_departure({0, 4, 0, 0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(first_departure({0, 0, -8, 0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(first_departure({0, 0, 0, 16}, 2), 0.5);
  EXPECT_DOUBLE_EQ(first_departure({0, 0, 0, -16}, 2), 0.5);
}

TEST(Departure, NeverComesWhereNothingMoves) {
  EXPECT_EQ(first_departure({0, 0, 0, 0}, 2), infinite);
  EXPECT_EQ(first_departure({1, 0, 0, 0}, 2), infinite);
}

TEST(Departure, LooksBeyondATurn) {
  // -1 + (s - 1)^2 stays above -1, and is 2 at 1 + sqrt(3); with 2 (s - 1)^2 - 2 it has left through -1.
  EXPECT_DOUBLE_EQ(first_departure({0, -2, 1, 0}, 2), 1 + std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(first_departure({0, -4, 2, 0}, 1), 1 - std::sqrt(0.5));
  // s^3 - 3 s turns at -2 in s = 1, and is 4 at 2.1958..: (s^3 - 3 s - 4 = 0).
  EXPECT_NEAR(first_departure({0, -3, 0, 1}, 4), 2.1958233454456471, 4 * eps * 2.2);
  EXPECT_NEAR(first_departure({0, 3, 0, -1}, 4), 2.1958233454456471, 4 * eps * 2.2);
}

TEST(Departure, IsAtOnceOnTheBorderOutwardAndLaterInward) {
  EXPECT_EQ(first_departure({2, 1, 0, 0}, 2), 0);
  EXPECT_EQ(first_departure({2, 0, 0, 1}, 2), 0);
  EXPECT_EQ(first_departure({2.0000001, 1, 0, 0}, 2), 0);  // rounded out of the band
  EXPECT_EQ(first_departure({2, -1, 0, 0}, 2), 4);
  EXPECT_EQ(first_departure({-2, 1, 0, 0}, 2), 4);
}

TEST(Departure, OfACubicIsTheFirstOfAFineGrid) {
  // 20000 random cubics of all proportions: at s the value is the width to rounding, and at no point of a grid before
  // it is |c| larger.
  constexpr std::uint64_t seed = 11;
  std::uint64_t drawn = 0;
  const auto random = [&] { return 2 * uniform(seed, 0, drawn++) - 1; };
  for (int trial = 0; trial < 20000; ++trial) {
    Cubic c{0.999 * random(), 0, 0, 0};
    for (int k = 1; k < 4; ++k) c[k] = random() * std::pow(10.0, 3 * random());
    const double s = first_departure(c, 1);
    ASSERT_GE(s, 0);
    ASSERT_LT(s, infinite);  // c3 is not 0
    double size = 0, slope = 0;
    for (int k = 0; k < 4; ++k) size += std::abs(c[k]) * std::pow(s, k);
    for (int k = 1; k < 4; ++k) slope += k * std::abs(c[k]) * std::pow(s, k - 1);
    const double rounding = 8 * eps * (size + s * slope);
    ASSERT_NEAR(std::abs(horner(c, s)), 1, rounding) << trial;
    for (int i = 0; i < 200; ++i) ASSERT_LE(std::abs(horner(c, s * i / 200)), 1 + rounding) << trial;
  }
}

}  // namespace
}  // namespace jetlag::testing::departure_test
