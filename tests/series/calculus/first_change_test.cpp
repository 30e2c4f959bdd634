// SPDX-License-Identifier: MIT
#include "jetlag/series/calculus/first_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "support/digits50.hpp"

namespace jetlag::testing::first_change_test {
namespace {

std::optional<double> change(const std::vector<double>& c, double h, int at_zero = 0) {
  return first_change<double>(c, at_zero, h);
}

TEST(FirstChange, IsJustBeyondTheFirstRoot) {  // (s - 1/2)(s - 1): beyond by its rounding over its slope
  const auto s = change({0.5, -1.5, 1.0}, 2.0);
  ASSERT_TRUE(s.has_value());
  EXPECT_GT(*s, 0.5);
  EXPECT_LT(*s, 0.5 + 64 * 0x1p-52);
  EXPECT_LT((*s - 0.5) * (*s - 1), 0);
}

TEST(FirstChange, ReachesALineOfAnyDegree) {  // t - 1: its term of order 1 does not mean that more follow
  for (int degree = 2; degree < 9; ++degree) {
    std::vector<double> c(degree + 1, 0.0);
    c[0] = -1;
    c[1] = 1;
    EXPECT_EQ(jetlag::reach_of_condition<double>(c, 3.0), 3.0) << degree;
  }
}

TEST(FirstChange, OfARootOfZeroWithoutASeriesDecidesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(jetlag::reach_of_condition<double>(std::vector<double>{0, nan, nan, nan}, 3.0), 3.0);
  EXPECT_LT(jetlag::reach_of_condition<double>(std::vector<double>{-0.5, nan, nan, nan}, 3.0), 1e-60);
}

TEST(FirstChange, IsNoneOfWhatStaysOrTouches) {
  EXPECT_FALSE(change({0.5, -1.5, 1.0}, 0.4).has_value());
  EXPECT_FALSE(change({1.0, -2.0, 1.0}, 2.0).has_value());  // (s - 1)^2
  EXPECT_FALSE(change({0.0, 0.0, 0.0}, 2.0).has_value());
  EXPECT_FALSE(change({std::numeric_limits<double>::quiet_NaN(), 1.0}, 2.0).has_value());
}

TEST(FirstChange, OfARootThatHasNoSeriesThereIsThatOfItsArgument) {
  // (1/2 - s)^(3/2), 20 coefficients: its polynomial reaches no zero, and tells no farther than a part of the way.
  std::vector<double> root{std::pow(0.5, 1.5)};
  for (int k = 1; k < 20; ++k) root.push_back(root.back() * (2.5 - k) / k * -2);
  const std::vector<double> crosses{0.5, -1.0}, stays{0.5, 1.0};
  const auto found = [&](const std::vector<double>& f) {
    double most = 2;
    std::optional<double> first;
    find_first_change_of_root<double>(f, root, 0, most, first);
    return std::pair(most, first);
  };
  const auto [most, first] = found(crosses);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(most, *first);
  EXPECT_GT(*first, 0.5);
  EXPECT_LT(*first, 0.5 + 64 * 0x1p-52);
  EXPECT_LT(found(stays).first, 0.25);  // as of the root alone
  EXPECT_FALSE(found(stays).second.has_value());
}

TEST(FirstChange, OfARootOfOrderThreeIsWhereItRisesOutOfRounding) {  // (s - 1)^3
  const auto s = change({-1.0, 3.0, -3.0, 1.0}, 2.0);
  ASSERT_TRUE(s.has_value());
  // |s - 1|^3 = 16 eps (1 + s)^3, and the root itself is seen within the same
  EXPECT_NEAR(*s, 1.0, 2 * std::cbrt(128 * 0x1p-52));
  EXPECT_GT(*s, 1.0);
}

TEST(FirstChange, FromZeroIsAtOnceWhereTheOtherSideWasTaken) {
  EXPECT_FALSE(change({0.0, 1.0}, 1.0).has_value());
  EXPECT_FALSE(change({0.0, 1.0}, 1.0, 1).has_value());
  const auto s = change({0.0, 1.0}, 1.0, -1);
  ASSERT_TRUE(s.has_value());
  EXPECT_LE(*s, 0x1p-52);
  EXPECT_NEAR(change({0.0, 1.0, -2.0}, 1.0).value(), 0.5, 64 * 0x1p-52);  // out and back
}

TEST(FirstChange, IsFoundWhereCoefficientsOverflow) {  // the first ones decide
  EXPECT_NEAR(change({1.0, -2.0, 0.0, 1e300, 1e305}, 0.75).value_or(-1), 0.5, 64 * 0x1p-52);
}

TEST(FirstChange, HasThePrecisionOfItsNumbers) {  // s^2 = 2
  const std::vector<Digits50> c{-2, 0, 1};
  const auto s = first_change<Digits50>(c, 0, Digits50(3));
  ASSERT_TRUE(s.has_value());
  EXPECT_LT(abs(*s - sqrt(Digits50(2))), Digits50(1e-47));
}

}  // namespace
}  // namespace jetlag::testing::first_change_test
