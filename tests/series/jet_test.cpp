// SPDX-License-Identifier: MIT
// Jets against coefficients known in closed form.
#include "jetlag/series/jet.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/binomial.hpp>
#include <boost/math/special_functions/factorials.hpp>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing::jet_test {
namespace {

template <int N>
using Exact = Jet<double, N>;  // where all coefficients are representable, equality is the test
template <int N>
using Tracked = Jet<RunningError<double>, N>;

/// C(a, k), the coefficients of (1 + t)^a, from the definition, in 50 digits.
Digits50 binomial(const Digits50& a, int k) {
  Digits50 product = 1;
  for (int j = 0; j < k; ++j) product *= (a - j) / (j + 1);
  return product;
}

TEST(Jet, HasTheExamplesOfItsFirstPage) {
  using J = Exact<3>;
  const J x = J::variable(2.0);
  EXPECT_EQ(x * x * x, J::from({8, 12, 6, 1}));
  EXPECT_EQ(1.0 / (x - 1.0), J::from({1, -1, 1, -1}));
}

TEST(Jet, GeometricSeriesIsAllOnes) {  // all intermediate numbers are small whole numbers: exact
  using J = Exact<60>;
  const J t = J::variable(0.0), geometric = 1.0 / (1.0 - t);
  for (int k = 0; k <= J::degree; ++k) EXPECT_EQ(geometric[k], 1.0);
}

TEST(Jet, ProductsOfPolynomialsExpand) {  // (1 - t^2)^3 = (1 - t)^3 (1 + t)^3, whole numbers: exact
  using J = Exact<8>;
  const J t = J::variable(0.0);
  EXPECT_EQ(pow(1.0 - t * t, 3), pow(1.0 - t, 3) * pow(1.0 + t, 3));
  EXPECT_EQ(pow(1.0 - t * t, 3), J::from({1, 0, -3, 0, 3, 0, -1}));
}

TEST(Jet, MixesWithPlainNumbersAsWithConstantJets) {  // one rounding each, the same: exact
  using J = Exact<5>;
  const J u = J::from({0.7, -1.3, 0.2, 5, 0.1, 9}), c(1.7);
  EXPECT_EQ(u + 1.7, u + c);
  EXPECT_EQ(1.7 + u, c + u);
  EXPECT_EQ(u - 1.7, u - c);
  EXPECT_EQ(1.7 - u, c - u);
  EXPECT_EQ(u * 1.7, J::from({0.7 * 1.7, -1.3 * 1.7, 0.2 * 1.7, 5 * 1.7, 0.1 * 1.7, 9 * 1.7}));
  EXPECT_EQ(1.7 * u, u * 1.7);
  EXPECT_EQ(u / 1.7, J::from({0.7 / 1.7, -1.3 / 1.7, 0.2 / 1.7, 5 / 1.7, 0.1 / 1.7, 9 / 1.7}));
  EXPECT_EQ(1.7 / u, c / u);
  EXPECT_EQ(2 * u, u + u);  // an int is a number too
  EXPECT_EQ(-u, 0.0 - u);
}

TEST(Jet, CompoundAssignmentIsTheOperator) {
  using J = Exact<3>;
  const J u = J::from({0.7, -1.3, 0.2, 5}), v = J::from({2, 3, 5, 7});
  J w = u;
  EXPECT_EQ(w += v, u + v);
  w = u;
  EXPECT_EQ(w -= v, u - v);
  w = u;
  EXPECT_EQ(w *= v, u * v);
  w = u;
  EXPECT_EQ(w /= v, u / v);
  w = u;
  EXPECT_EQ(w *= w, u * u);  // its own operand
}

TEST(Sqrt, OfOnePlusTHasBinomialCoefficients) {
  using J = Exact<8>;  // C(1/2, k) are binary fractions: exact
  const J s = sqrt(1.0 + J::variable(0.0));
  EXPECT_EQ(s[2], -1.0 / 8.0);
  EXPECT_EQ(s[3], 1.0 / 16.0);
  for (int k = 0; k <= J::degree; ++k) EXPECT_EQ(s[k], static_cast<double>(binomial(0.5, k)));
}

TEST(Pow, OfOnePlusTHasBinomialCoefficients) {
  const auto t = Tracked<20>::variable(0.0);
  const double third = 1.0 / 3.0;  // not 1/3: the truth has the same exponent
  EXPECT_THAT(pow(1.0 + t, third), HasCoefficients([&](int k) { return binomial(third, k); }));
  EXPECT_THAT(pow(1.0 + t, third)[2], IsCloseTo(-1.0 / 9.0, ulps(8)));     // the exponent's own half ulp
  EXPECT_THAT(pow(1.0 + t, third)[4], IsCloseTo(-10.0 / 243.0, ulps(8)));  // enters a few times
  EXPECT_THAT(pow(1.0 + t, -2.5), HasCoefficients([](int k) { return binomial(-2.5, k); }));
}

TEST(Pow, HasPublishedCoefficients) {
  // TaylorSeries.jl: (1 - t)^(1/4), an exact fraction; (1 + t)^3.2, eleven digits
  const auto quarter = pow(1.0 - Tracked<14>::variable(0.0), 0.25);
  EXPECT_THAT(quarter[14], IsCloseTo(-4188908511.0 / 549755813888.0, CarriedError{}));
  const auto p = pow(1.0 + Exact<13>::variable(0.0), 3.2);
  EXPECT_NEAR(p[13], -5.4021062656e-5, 0.5e-15);
}

TEST(Pow, OfWholeExponentsIsAPolynomialEverywhere) {
  using J = Exact<6>;
  const J t = J::variable(0.0), x = J::variable(-2.0);
  for (int n = 0; n <= 6; ++n) {
    J power_of_t;
    power_of_t[n] = 1.0;
    EXPECT_EQ(pow(t, n), power_of_t) << n;
    EXPECT_EQ(pow(t, static_cast<double>(n)), power_of_t) << n;
    EXPECT_EQ(pow(t, static_cast<float>(n)), power_of_t) << n;
  }
  EXPECT_EQ(pow(x, 3), J::from({-8, 12, -6, 1}));
  EXPECT_EQ(pow(x, 3.0), J::from({-8, 12, -6, 1}));
  EXPECT_EQ(pow(x, -1), 1.0 / x);
  EXPECT_EQ(pow(x, -2.0), 1.0 / (x * x));
}

TEST(Pow, OfTwoSeriesIsTheirPower) {  // (1 + t)^(1 + t): whole numbers over factorials, OEIS A005727
  const auto x = Tracked<6>::variable(1.0);
  const double numerators[] = {1, 1, 2, 3, 8, 10, 54};
  EXPECT_THAT(pow(x, x),
              HasCoefficients([&](int k) { return numerators[k] / boost::math::factorial<Digits50>(k); }));
  EXPECT_EQ(pow(Exact<4>::variable(-2.0), Exact<4>(3.0)), Exact<4>::from({-8, 12, -6, 1}));
}

TEST(Exp, HasInverseFactorials) {
  EXPECT_THAT(exp(Tracked<20>::variable(0.0)),
              HasCoefficients([](int k) { return Digits50(1) / boost::math::factorial<Digits50>(k); }));
}

TEST(Log, HasInverseWholeNumbers) {
  EXPECT_THAT(log(1.0 + Tracked<20>::variable(0.0)),
              HasCoefficients([](int k) { return k == 0 ? Digits50(0) : Digits50(k % 2 ? 1 : -1) / k; }));
}

TEST(SinCos, HaveInverseFactorialsOfAlternatingSign) {
  const auto t = Tracked<20>::variable(0.0);
  const auto inverse = [](int k) {
    return Digits50(k / 2 % 2 ? -1 : 1) / boost::math::factorial<Digits50>(k);
  };
  EXPECT_THAT(sin(t), HasCoefficients([&](int k) { return k % 2 ? inverse(k) : Digits50(0); }));
  EXPECT_THAT(cos(t), HasCoefficients([&](int k) { return k % 2 ? Digits50(0) : inverse(k); }));
  EXPECT_THAT(cos(t)[8], IsCloseTo(1.0 / 40320.0, CarriedError{}));
}

TEST(SinCos, HaveTheTangentAsQuotient) {
  const auto t = Tracked<13>::variable(0.0);
  const auto tan = sin(t) / cos(t);
  EXPECT_THAT(tan[7], IsCloseTo(Digits50(17) / 315, CarriedError{}));
  EXPECT_THAT(tan[13], IsCloseTo(Digits50(21844) / 6081075, CarriedError{}));
}

TEST(Jet, QuotientWithACommonPowerIsReduced) {  // t/(t + t^2) = 1/(1 + t), but for the top coefficient
  using J = Exact<6>;
  const J t = J::variable(0.0), q = t / (t + t * t);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(q[k], k % 2 ? -1.0 : 1.0);
  EXPECT_TRUE(std::isnan(q[6]));
}

TEST(Jet, QuotientOfZeroByAPowerOfTIsZeroAsFarAsItIsKnown) {
  using J = Exact<4>;
  const J t = J::variable(0.0), q = J(0.0) / (t * t);
  for (int k = 0; k <= 2; ++k) EXPECT_EQ(q[k], 0.0);
  EXPECT_TRUE(std::isnan(q[3]));
  EXPECT_TRUE(std::isnan(q[4]));
}

TEST(Jet, DerivativeLowersPowers) {  // of t^k; small whole numbers: exact
  using J = Exact<5>;
  EXPECT_EQ(derivative(J::from({1, 2, 3, 4, 5, 6})), J::from({2, 6, 12, 20, 30, 0}));
}

TEST(Jet, DerivativeOfExpIsExp) {
  using J = Tracked<12>;
  const J v = exp(J::variable(0.3));
  const J w = derivative(v);
  for (int k = 0; k < J::degree; ++k) EXPECT_THAT(w[k], IsCloseTo(v[k])) << k;
}

TEST(Jet, ShiftedOriginExpandsABinomial) {  // t^5 about s = 2 is (2 + t)^5: exact
  using J = Exact<5>;
  EXPECT_EQ(shift_origin(J::from({0, 0, 0, 0, 0, 1}), 2.0), J::from({32, 80, 80, 40, 10, 1}));
}

TEST(Jet, ShiftedOriginTakesTheSameValues) {  // quarters and small whole numbers: exact
  using J = Exact<5>;
  const J u = J::from({3, -1, 4, 1, -5, 9});
  for (const double s : {-1.5, 0.25, 2.0})
    for (const double t : {-0.75, 0.0, 1.25}) EXPECT_EQ(shift_origin(u, s)(t), u(s + t));
}

TEST(Jet, IsEvaluatedByItsCoefficients) {
  using J = Exact<4>;
  const J u = J::from({1, 2, 3, 4, 5});
  EXPECT_EQ(u(10.0), 54321.0);
  EXPECT_EQ(u(0.0), 1.0);
  EXPECT_EQ(Exact<1>::variable(0.5)(2), 2.5);  // at a whole number too
  EXPECT_EQ(Exact<0>(7.0)(3.0), 7.0);
}

TEST(Jet, IsComposedWithAnotherJet) {  // exp(sin t) = e^u at u = sin t, coefficients by OEIS A002017 / k!
  using J = Tracked<8>;
  const J t = J::variable(0.0);
  const double numerators[] = {1, 1, 1, 0, -3, -8, -3, 56, 217};
  EXPECT_THAT(exp(t)(sin(t)),
              HasCoefficients([&](int k) { return numerators[k] / boost::math::factorial<Digits50>(k); }));
}

// ---- jets of jets: mixed partial derivatives --------------------------------------------------------------

template <int N>
using Nested = Jet<Jet<RunningError<double>, N>, N>;

/// x + s + t, with s the variable of the outer jet and t that of the inner.
template <int N>
Nested<N> sum_of_two_variables(double x) {
  using Inner = Jet<RunningError<double>, N>;
  return Nested<N>::variable(Inner::variable(x));
}

TEST(NestedJet, HasMixedPartialsOfFunctionsOfASum) {
  // d^i/ds^i d^j/dt^j f(x + s + t) / (i! j!) = C(i + j, i) f_{i+j}, f_k the coefficients of f at x
  constexpr int N = 5;
  const double x = 0.8;
  const auto sum = sum_of_two_variables<N>(x);
  const auto expect = [&](const Nested<N>& actual, auto f, const char* name) {
    for (int i = 0; i <= N; ++i)
      EXPECT_THAT(actual[i], HasCoefficients([&](int j) {
                    return boost::math::binomial_coefficient<Digits50>(i + j, i) * f(i + j);
                  }))
          << name << ", order " << i << " in s";
  };
  using boost::math::factorial;
  const Digits50 X = x;
  expect(1.0 / sum, [&](int k) { return binomial(-1, k) * pow(X, -1 - k); }, "reciprocal");
  expect(sqrt(sum), [&](int k) { return binomial(0.5, k) * pow(X, Digits50(0.5) - k); }, "sqrt");
  expect(pow(sum, -1.5), [&](int k) { return binomial(-1.5, k) * pow(X, Digits50(-1.5) - k); }, "pow");
  expect(exp(sum), [&](int k) { return exp(X) / factorial<Digits50>(k); }, "exp");
  expect(log(sum), [&](int k) { return k == 0 ? log(X) : Digits50(k % 2 ? 1 : -1) / k * pow(X, -k); }, "log");
  expect(
      sin(sum),
      [&](int k) { return (k / 2 % 2 ? -1 : 1) * (k % 2 ? cos(X) : sin(X)) / factorial<Digits50>(k); },
      "sin");
}

TEST(NestedJet, HasMixedPartialsOfAProductOfDifferentFunctions) {  // s^i t^j of e^{x+s} / (y+t), closed forms
  constexpr int N = 4;
  using Inner = Jet<RunningError<double>, N>;
  const double x = -0.4, y = 1.25;
  const auto f = exp(Nested<N>::variable(Inner(x))) / Nested<N>(Inner::variable(y));
  for (int i = 0; i <= N; ++i)
    EXPECT_THAT(f[i], HasCoefficients([&](int j) {
                  return exp(Digits50(x)) / boost::math::factorial<Digits50>(i) * (j % 2 ? -1 : 1) *
                         pow(Digits50(y), -1 - j);
                }));
}

TEST(RunningError,
     HasTheBitsOfPlainNumbers) {  // what is proved of Jet<RunningError<T>, N> holds for Jet<T, N>
  Uniform draw(1);
  Exact<20> u;
  Tracked<20> tracked;
  for (int k = 0; k <= 20; ++k) tracked[k] = u[k] = k == 0 ? 1.5 : draw(-1, 1);
  const auto f = [](const auto& x) { return sin(exp(x) / sqrt(x)) - log(x) * pow(x, 2.7); };
  const auto plain = f(u);
  const auto with_error = f(tracked);
  for (int k = 0; k <= 20; ++k) EXPECT_EQ(plain[k], with_error[k].value) << k;
}

}  // namespace
}  // namespace jetlag::testing::jet_test
