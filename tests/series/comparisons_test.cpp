// SPDX-License-Identifier: MIT
// Comparisons of jets, and the functions that choose: select, abs, min, max.
#include "jetlag/series/comparisons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing::comparisons_test {
namespace {

using J = Jet<double, 4>;
const J t = J::variable(0.0);
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// ---- comparisons -----------------------------------------------------------------------------------------

TEST(Comparison, IsThatOfTheFirstCoefficientsThatDiffer) {
  const J one = J::from({1, 5, 5}), two = J::from({2, -7, 1}), less_soon = J::from({1, -3});
  EXPECT_TRUE(one < two);
  EXPECT_FALSE(two < one);
  EXPECT_TRUE(two > one);
  EXPECT_FALSE(one < less_soon);
  EXPECT_FALSE(one <= less_soon);
  EXPECT_TRUE(one >= less_soon);
  EXPECT_TRUE(one > less_soon);
  EXPECT_FALSE(one == less_soon);
  EXPECT_TRUE(one <= one);
  EXPECT_TRUE(one >= one);
  EXPECT_FALSE(one < one);
}

TEST(Comparison,
     IsThatOfValuesSoonAfterTheStart) {  // t = 1/64: 64 > 1 + 3 (1 + 1/64 + ...), a later term never decides
  Uniform draw(6);
  for (int i = 0; i < 100; ++i) {
    J u, v;
    for (int k = 0; k <= J::degree; ++k) u[k] = std::floor(draw(-1, 2)), v[k] = std::floor(draw(-1, 2));
    EXPECT_EQ(u < v, u(0x1p-6) < v(0x1p-6));
    EXPECT_EQ(u <= v, u(0x1p-6) <= v(0x1p-6));
    EXPECT_EQ(u == v, u(0x1p-6) == v(0x1p-6));
  }
}

TEST(Comparison, OfSquaresWithZeroIsNotThatOfEquals) {
  EXPECT_TRUE(t * t > 0.0);
  EXPECT_FALSE(t * t <= 0.0);
  EXPECT_TRUE(-t < 0.0);
  EXPECT_TRUE(0.0 * t <= 0.0);
}

TEST(Comparison, OfDynamicJetsIsOfWhatBothKnow) {
  using D = Jet<double, Dynamic>;
  const D u = D::from({1, 2}), v = D::from({1, 2, 3}), w = D::from({1, 2, 5});
  EXPECT_TRUE(v < w);
  EXPECT_FALSE(u < w);
  EXPECT_TRUE(u <= w);
  EXPECT_TRUE(u >= w);
  EXPECT_TRUE(u > 1.0);  // a constant knows all
  EXPECT_FALSE(D(1.0) >= u);
  EXPECT_TRUE(D(1.0) < D(2.0));
}

TEST(Comparison, TakesPlainNumbersOnEitherSide) {
  const J u = J::from({1, 5});
  EXPECT_TRUE(u > 0.5);
  EXPECT_TRUE(u > 0);
  EXPECT_TRUE(0.5 < u);
  EXPECT_TRUE(u >= 1.0);
  EXPECT_FALSE(1.0 >= u);  // it has left 1 upwards
  EXPECT_FALSE(2.0 < u);
}

TEST(Comparison, WithNaNDoesNotHold) {
  const J u(nan);
  EXPECT_FALSE(u < 1.0);
  EXPECT_FALSE(u <= 1.0);
  EXPECT_FALSE(u > 1.0);
  EXPECT_FALSE(u >= 1.0);
}

TEST(Comparison, OfJetsOfJetsIsThatOfTheFirstThatDiffer) {
  using Nested = Jet<Jet<double, 2>, 3>;
  const Nested u(Jet<double, 2>::from({1, 9})), v(Jet<double, 2>::from({1, -9}));
  EXPECT_FALSE(u <= v);
  EXPECT_TRUE(u > v);
  EXPECT_TRUE(v + 1.0 > u);
}

// ---- select ----------------------------------------------------------------------------------------------

template <class T>
T softened(const T& x) {  // x below 1, its root from there on
  using std::sqrt;
  return select(x < 1.0, x, sqrt(x));
}

TEST(Select, ServesNumbersAndJetsAlike) {
  EXPECT_EQ(softened(0.25), 0.25);
  EXPECT_EQ(softened(9.0), 3.0);
  EXPECT_EQ(softened(9.0f), 3.0f);
  EXPECT_EQ(softened(Digits50(9)), 3);
  EXPECT_EQ(softened(J::variable(0.25)), J::variable(0.25));
  EXPECT_EQ(softened(J::variable(4.0)), sqrt(J::variable(4.0)));
}

TEST(Select, TakesPlainNumbersAsBranches) {
  EXPECT_EQ(select(t < 1.0, t, 2.0), t);
  EXPECT_EQ(select(t < 1.0, 2.0, t), J(2.0));
  EXPECT_EQ(select(t < 1.0, 2, t), J(2.0));
  EXPECT_EQ(select(t > 1.0, 2, 3.5), 3.5);
}

TEST(Select, IsNotHarmedByABranchThatIsNotSelected) {
  EXPECT_EQ(select(t > -1.0, t, log(t - 1.0)), t);
  EXPECT_EQ(select(t > 1.0, J(nan), 1.0), J(1.0));
}

TEST(Select, DecidesSoonAfterTheExpansionPoint) {
  EXPECT_EQ(select(t < 0.0, -t, t), t);
  EXPECT_EQ(select(-t < 0.0, t, -t), t);
  EXPECT_EQ(select(t > 0.0, 1.0 + t, 2.0), 1.0 + t);
  EXPECT_EQ(select(-t * t >= 0.0, 1.0, 2.0), 2.0);
}

// ---- the sign of a series --------------------------------------------------------------------------------

TEST(Abs, KeepsTheSignOfTheFirstCoefficient) {
  const J u = J::from({0.5, -3, 7, 0, -1});
  EXPECT_EQ(abs(u), u);
  EXPECT_EQ(abs(-u), u);
}

TEST(Abs, HasNoKinkAtAZeroOfEvenOrder) {
  EXPECT_EQ(abs(-t * t), t * t);
  EXPECT_EQ(abs(-t * t + t * t * t), t * t - t * t * t);
  EXPECT_EQ(abs(-square(square(t))), square(square(t)));
}

TEST(Abs, AtAKinkIsThatOfTheSideThatIsEntered) {  // t >= 0
  EXPECT_EQ(abs(t), t);
  EXPECT_EQ(abs(-t), t);
  EXPECT_EQ(abs(-t * t * t), t * t * t);
  EXPECT_EQ(abs(t * t - t), t - t * t);  // |t| (1 - t)
  EXPECT_EQ(abs(sin(-t)), sin(t));
}

TEST(Abs, OfCheckedAndDynamicJetsIsTheSame) {
  const auto x = CheckedJet<double, 4>::variable(0.0);
  EXPECT_EQ(abs(-x), x);
  EXPECT_EQ(max(-x, x), x);
  const auto y = Jet<double, Dynamic>::variable(0.0, 4);
  EXPECT_EQ(abs(-y), y);
  EXPECT_EQ(abs(0.0 * y), 0.0 * y);
  EXPECT_EQ(abs(0.0 * y).degree(), 4);
  EXPECT_EQ(min(y, Jet<double, Dynamic>::from({0, 0, 1})).degree(), 2);
}

TEST(Abs, OfWhatVanishesAsFarAsItIsKnownIsZero) { EXPECT_EQ(abs(-pow(t, 5)), J(0.0)); }

TEST(Abs, BeyondACoefficientThatIsNotKnownIsNotKnown) {
  EXPECT_EQ(known_degree(abs(J::from({0, nan, 1}))), 0);
  EXPECT_EQ(abs(J::from({0, -1, nan, 1}))[1], 1.0);
}

TEST(Abs, OfZeroIsZero) { EXPECT_EQ(abs(J(0.0)), J(0.0)); }

TEST(Abs, OfNaNIsNaN) {
  for (int k = 0; k <= J::degree; ++k) EXPECT_TRUE(std::isnan(abs(J(nan))[k])) << k;
}

TEST(Abs, IsTheRootOfTheSquare) {
  Uniform draw(4);
  for (int i = 0; i < 20; ++i) {
    J u;
    for (int k = 0; k <= J::degree; ++k) u[k] = draw(-1, 1);
    const J root = sqrt(u * u), size = abs(u);
    // sqrt divides by 2 |u_0| at each order: a rounding error grows by at most (1 + 4/|u_0|) in each
    for (int k = 0; k <= J::degree; ++k)
      EXPECT_NEAR(root[k], size[k], 0x1p-50 * std::pow(1 + 4 / std::abs(u[0]), k)) << k;
  }
}

TEST(MinMax, ChooseBySign) {
  const J u = J::from({1, 2, 3}), v = J::from({2, -1, 0.5});
  EXPECT_EQ(min(u, v), u);
  EXPECT_EQ(min(v, u), u);
  EXPECT_EQ(max(u, v), v);
  EXPECT_EQ(max(v, u), v);
}

TEST(MinMax, LookFurtherWhereTheFirstCoefficientsAgree) {
  const J u = J::from({1, 2, 3}), v = J::from({1, 2, 5, -9});
  EXPECT_EQ(min(u, v), u);
  EXPECT_EQ(min(v, u), u);
  EXPECT_EQ(max(u, v), v);
  EXPECT_EQ(max(v, u), v);
}

TEST(MinMax, WhereTheSeriesCrossAreThoseOfTheSideThatIsEntered) {
  const J u = J::from({1, 2, 3, 4}), v = J::from({1, 2, 3, 5});
  EXPECT_EQ(min(u, v), u);
  EXPECT_EQ(min(v, u), u);
  EXPECT_EQ(max(u, v), v);
  EXPECT_EQ(max(t, 0.0), t);
  EXPECT_EQ(max(-t, 0.0), J(0.0));
  EXPECT_EQ(min(sin(t), 0.0), J(0.0));
  EXPECT_EQ(max(sin(t), 0.0), sin(t));
}

TEST(MinMax, OfEqualSeriesIsEither) {
  const J u = J::from({1, 2, 3, 4});
  EXPECT_EQ(min(u, u), u);
  EXPECT_EQ(max(u, u), u);
}

TEST(MinMax, TakePlainNumbersOnEitherSide) {
  const J u = J::from({2, 1});
  EXPECT_EQ(max(u, 0.0), u);
  EXPECT_EQ(max(0.0, u), u);
  EXPECT_EQ(max(u, 3), J(3.0));
  EXPECT_EQ(min(u, 0), J(0.0));
  EXPECT_EQ(min(3.0, u), u);
}

TEST(MinMax, SumToTheSumAndDifferByTheAbsoluteDifference) {
  Uniform draw(5);
  for (int i = 0; i < 20; ++i) {
    J u, v;
    for (int k = 0; k <= J::degree; ++k) u[k] = draw(-1, 1), v[k] = draw(-1, 1);
    EXPECT_EQ(min(u, v) + max(u, v), u + v);
    EXPECT_EQ(max(u, v) - min(u, v), abs(u - v));
  }
}

// ---- laws written as numbers are -------------------------------------------------------------------------

template <class T>
T with_using(const T& x, const T& y) {
  using std::abs, std::atan2, std::hypot, std::max, std::min, std::pow;
  return abs(x) + max(x, y) + min(x, y) + hypot(x, y) + atan2(y, x) + pow(x, 2.5);
}
template <class T>
T with_names(const T& x, const T& y) {
  return jetlag::abs(x) + jetlag::max(x, y) + jetlag::min(x, y) + jetlag::hypot(x, y) + jetlag::atan2(y, x) +
         jetlag::pow(x, 2.5);
}

TEST(Choices, AreWrittenAlikeForNumbersAndJets) {
  const double value = with_using(1.5, -2.0);
  EXPECT_EQ(value, 1.5 + 1.5 - 2.0 + 2.5 + std::atan2(-2.0, 1.5) + std::pow(1.5, 2.5));
  EXPECT_EQ(with_names(1.5, -2.0), value);
  EXPECT_EQ(with_using(J::variable(1.5), J(-2.0))[0], value);
  EXPECT_EQ(with_names(J::variable(1.5), J(-2.0)), with_using(J::variable(1.5), J(-2.0)));
}

}  // namespace
}  // namespace jetlag::testing::comparisons_test
