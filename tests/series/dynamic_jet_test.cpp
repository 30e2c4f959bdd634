// SPDX-License-Identifier: MIT
// Jets whose degree is known at run time: they know what their operands determine.
#include <gtest/gtest.h>

#include <boost/math/special_functions/factorials.hpp>
#include <limits>
#include <type_traits>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing::dynamic_jet_test {
namespace {

using D = Jet<double, Dynamic>;

D random_series(int degree, int seed) {
  Uniform draw(seed);
  D u = D::variable(draw(0.5, 2.0), degree);
  for (int k = 1; k <= degree; ++k) u[k] = draw(-1, 1);
  return u;
}

// ---- the degree -------------------------------------------------------------------------------------------

TEST(DynamicJet, HasTheDegreeItIsMadeWith) {
  EXPECT_EQ(D::variable(2.0, 5).degree(), 5);
  EXPECT_EQ(D::variable(2.0, 0).degree(), 0);
  EXPECT_EQ(D::from({1, 2, 3}).degree(), 2);
  EXPECT_EQ(D::from(std::vector<double>{1, 2, 3, 4}), D::from({1, 2, 3, 4}));
  EXPECT_EQ(D::variable(2.0, 2), D::from({2, 1, 0}));
}

TEST(StaticJet, TellsItsDegreeInTheSameWords) {
  using J = Jet<double, 7>;
  static_assert(J::degree == 7);
  static_assert(std::is_same_v<Jet<double, J::degree>, J>);
  EXPECT_EQ(J(1.0).degree(), 7);
}

TEST(DynamicJet, OfBinaryOperationsHasTheSmallerDegree) {
  const D u = random_series(5, 1), v = random_series(3, 2);
  for (const D& w : {u + v, v + u, u - v, v - u, u * v, v * u, u / v, v / u, pow(u, v), pow(v, u)})
    EXPECT_EQ(w.degree(), 3);
  for (const D& w :
       {u + u, u * u, u / u, -u, sqrt(u), exp(u), log(u), sin(u), cos(u), pow(u, 3), pow(u, 0.3)})
    EXPECT_EQ(w.degree(), 5);
}

TEST(DynamicJet, OfAPlainNumberAdapts) {  // it has no degree of its own
  const D u = random_series(5, 1), one(1.0);
  for (const D& w : {u + one, one + u, u - one, one - u, u * one, u / one, one / u, u + 1.0, 1.0 / u, 2 * u})
    EXPECT_EQ(w.degree(), 5);
  EXPECT_EQ(one + u, 1.0 + u);
  EXPECT_EQ(one / u, 1.0 / u);
  EXPECT_EQ(u * D(3.0), 3.0 * u);
  EXPECT_EQ(pow(u, 0) * u, u);
  for (const D& w : {one + one, one / D(3.0), sqrt(one), pow(one, 1.5), sin(one), exp(one), D()})
    EXPECT_TRUE(w.is_constant());
  EXPECT_FALSE((u - u).is_constant());
  EXPECT_EQ(one[17], 0.0);  // all its coefficients are known
}

TEST(DynamicJet, IsEqualToWhatHasTheSameCoefficients) {
  EXPECT_EQ(D::from({3, 0, 0}), D(3.0));
  EXPECT_EQ(D(3.0), 3.0);
  EXPECT_NE(D::from({3, 0, 1}), D(3.0));
  EXPECT_NE(D(3.0), D::from({3, 0, 1}));
  EXPECT_NE(D::from({3, 0}), D::from({3, 0, 0}));  // not as much is known
}

TEST(DynamicJet, HasTheBitsOfTheStaticJet) {
  constexpr int N = 12;
  const D u = random_series(N, 1), v = random_series(N, 2);
  const Jet<double, N> x(u), y(v);
  const auto f = [](const auto& a, const auto& b) {
    return sin(exp(a) / sqrt(b)) - log(a) * pow(b, 2.7) + square(a) / 3.0 - 2.0 / b;
  };
  EXPECT_EQ(f(u, v), D(f(x, y)));
}

TEST(DynamicJet, IsLessWhereARemovableSingularityTakesCoefficients) {
  const D t = D::variable(0.0, 6);
  EXPECT_EQ(t / (t + t * t), D::from({1, -1, 1, -1, 1, -1}));
  EXPECT_EQ((sin(t) / t).degree(), 5);
  EXPECT_EQ(((1.0 - cos(t)) / (t * t)).degree(), 4);
  EXPECT_EQ(0.0 / t, D::from({0, 0, 0, 0, 0, 0}));
}

TEST(KnownDegree, IsThatOfTheLastFiniteCoefficientInARow) {
  using J = Jet<double, 4>;
  const J t = J::variable(0.0);
  EXPECT_EQ(known_degree(exp(t)), 4);
  EXPECT_EQ(known_degree(t * t / (t * t)), 2);
  EXPECT_EQ(known_degree(1.0 / t), -1);
  EXPECT_EQ(known_degree(D::variable(1.0, 9)), 9);
  EXPECT_EQ(known_degree(D::variable(0.0, 9) / D::variable(0.0, 9)), 8);
}

TEST(DynamicJet, IsWrittenByItsCoefficients) {
  D u = D::variable(2.0, 1);
  u.append(5.0);
  EXPECT_EQ(u, D::from({2, 1, 5}));
  u.resize(1);
  EXPECT_EQ(u, D::from({2, 1}));
  u.resize(3);
  EXPECT_EQ(u, D::from({2, 1, 0, 0}));
  u[2] = 7.0;
  EXPECT_EQ(u[2], 7.0);
}

// ---- conversion -------------------------------------------------------------------------------------------

TEST(Conversion, KeepsWhatBothDegreesHold) {
  using J = Jet<double, 3>;
  EXPECT_EQ(J(D::from({1, 2, 3, 4, 5})), J::from({1, 2, 3, 4}));
  EXPECT_EQ(D(J::from({1, 2, 3, 4})), D::from({1, 2, 3, 4}));
  EXPECT_EQ((Jet<double, 2>(J::from({1, 2, 3, 4}))), (Jet<double, 2>::from({1, 2, 3})));
}

TEST(Conversion, OfAConstantHasZerosAndOfAShorterSeriesNaN) {
  using J = Jet<double, 3>;
  EXPECT_EQ(J(D(7.0)), J(7.0));
  const J wider(D::from({1, 2}));
  EXPECT_EQ(known_degree(wider), 1);
  EXPECT_EQ(wider[1], 2.0);
  EXPECT_EQ(known_degree(J(Jet<double, 1>::from({1, 2}))), 1);
}

TEST(Conversion, IsNotTakenUnasked) {
  static_assert(!std::is_convertible_v<Jet<double, 3>, D>);
  static_assert(!std::is_convertible_v<D, Jet<double, 3>>);
  static_assert(!std::is_convertible_v<Jet<double, 3>, Jet<double, 4>>);
  static_assert(!std::is_convertible_v<Jet<double, 3>, CheckedJet<double, 3>>);
  static_assert(std::is_convertible_v<int, D>);
}

// ---- calculus ---------------------------------------------------------------------------------------------

TEST(DynamicJet, DerivativeKnowsOneCoefficientLess) {
  EXPECT_EQ(derivative(D::from({1, 2, 3, 4})), D::from({2, 6, 12}));
  EXPECT_EQ(derivative(D(3.0)), D(0.0));
  EXPECT_EQ(known_degree(derivative(D::from({3}))), -1);
}

TEST(Integral, RaisesPowers) {  // of t^k; small whole numbers: exact
  EXPECT_EQ(integral(D::from({2, 6, 12}), 1.0), D::from({1, 2, 3, 4}));
  using J = Jet<double, 3>;
  EXPECT_EQ(integral(J::from({2, 6, 12, 99}), 1.0), J::from({1, 2, 3, 4}));
  EXPECT_EQ(integral(D(3.0)), D::from({0, 3}));
}

TEST(Integral, UndoesTheDerivative) {  // one division and one product by k, half an ulp each
  const D u = random_series(40, 3);
  EXPECT_THAT(integral(derivative(u), u[0]), HasCoefficients([&](int k) { return u[k]; }, ulps(1)));
  EXPECT_THAT(derivative(integral(u)), HasCoefficients([&](int k) { return u[k]; }, ulps(1)));
}

TEST(Integral, OfTheReciprocalIsTheLogarithm) {
  const auto x = Jet<RunningError<double>, Dynamic>::variable(1.5, 20);
  EXPECT_THAT(integral(1.0 / x, log(x[0])),
              IsCloseTo(log(Jet<RunningError<double>, Dynamic>::variable(1.5, 21))));
}

TEST(DynamicJet, ShiftsItsOriginAsAPolynomial) {
  EXPECT_EQ(shift_origin(D::from({0, 0, 0, 0, 0, 1}), 2.0), D::from({32, 80, 80, 40, 10, 1}));
  EXPECT_EQ(shift_origin(D(3.0), 2.0), D(3.0));
}

TEST(DynamicJet, IsEvaluatedAndComposed) {
  EXPECT_EQ(D::from({1, 2, 3})(10.0), 321.0);
  EXPECT_EQ(D(7.0)(10.0), 7.0);
  const D t = D::variable(0.0, 4);  // exp(t^2) = e^u at u = t^2
  EXPECT_EQ(exp(t)(t * t), D::from({1, 0, 1, 0, 0.5}));
  EXPECT_EQ(D::from({1, 2})(t), D::from({1, 2, 0, 0, 0}));  // a polynomial of a longer series
}

// ---- degree 177: k! overflows a double from 171 on, normalised coefficients do not ----------------------------

/// 1/177!, from the logarithm of the gamma function's argument product in 50 digits.
Digits50 inverse_factorial(int n) {
  Digits50 product = 1;
  for (int k = 2; k <= n; ++k) product *= k;
  return 1 / product;
}

TEST(Jet, OfSinHasCoefficient177) {
  // 1/177! = 3e-323 is below the smallest normal double, 4.9e-324 is its spacing: half of that, after 1/k each
  // step of which is exact to half an ulp until the numbers are subnormal, the last 4 of them (k > 170)
  const auto s = sin(Jet<double, 177>::variable(0.0));
  const double spacing = std::numeric_limits<double>::denorm_min();
  EXPECT_NEAR(s[177], static_cast<double>(inverse_factorial(177)), 2 * spacing);
  EXPECT_GT(s[177], 0.0);
  const auto c = sin(D::variable(0.0, 177));
  for (int k = 0; k <= 177; ++k) EXPECT_EQ(c[k], s[k]) << k;
}

TEST(Jet, OfSinHasCoefficient177InMoreDigits) {  // 177 divisions, half an ulp each
  const auto s = sin(Jet<Digits50, 177>::variable(0.0));
  EXPECT_THAT(s[177], IsCloseTo(inverse_factorial(177), ulps(177)));
}

}  // namespace
}  // namespace jetlag::testing::dynamic_jet_test
