// SPDX-License-Identifier: MIT
// Removable singularities: a common power of t is cancelled, and what is lost by it is not made up.
#include "jetlag/series/valuation.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing::valuation_test {
namespace {

constexpr int N = 8;

/// Every test in static jets, which keep NaN for what is lost, and in dynamic ones, which become shorter.
template <class J>
class CommonPower : public ::testing::Test {
 protected:
  template <class T = typename J::value_type>
  static J variable(const T& x = T(0)) {
    if constexpr (J::degree_at_compile_time == Dynamic)
      return J::variable(x, N);
    else
      return J::variable(x);
  }
  const J t = variable();

  /// u is as long as `expected`, which is not shorter than N + 1 - `lost`, and close to it.
  static void expect_reduced(const J& u, const J& expected, int lost) {
    ASSERT_EQ(known_degree(u), N - lost);
    if (J::degree_at_compile_time == Dynamic) {
      EXPECT_EQ(u.degree(), N - lost);
    }
    for (int k = 0; k <= N - lost; ++k) EXPECT_THAT(u[k], IsCloseTo(expected[k])) << "coefficient " << k;
  }
};
using Number = RunningError<double>;
using Jets = ::testing::Types<Jet<Number, N>, Jet<Number, Dynamic>, CheckedJet<Number, N>,
                              CheckedJet<Number, Dynamic>>;
struct NameOfJet {
  template <class J>
  static std::string GetName(int) {
    return std::string(J::degree_at_compile_time == Dynamic ? "Dynamic" : "Static") +
           (J::singularities == Singularities::checked ? "Checked" : "");
  }
};
TYPED_TEST_SUITE(CommonPower, Jets, NameOfJet);

TYPED_TEST(CommonPower, OfAQuotientIsCancelled) {
  const auto& t = this->t;
  this->expect_reduced(t / t, TypeParam(1.0) + 0.0 * t, 1);
  this->expect_reduced(t / (t + t * t), 1.0 / (1.0 + t), 1);
  this->expect_reduced(t * t * exp(t) / (t * cos(t)), t * exp(t) / cos(t), 1);  // as much as the divisor has
  this->expect_reduced(0.0 / (t * t), 0.0 * t, 2);
}

TYPED_TEST(CommonPower, OfSinOverTAndOfTheVersineIsCancelled) {  // sin(t)/t = sum (-t^2)^n / (2n+1)!
  const auto& t = this->t;
  TypeParam sinc = 0.0 * t, versine = 0.0 * t;
  double factorial = 1;
  for (int k = 1; k <= N + 2; ++k) {
    factorial *= k;
    if (k % 2 == 1 && k - 1 <= N) sinc[k - 1] = Number(k / 2 % 2 ? -1.0 : 1.0) / Number(factorial);
    if (k % 2 == 0 && k - 2 <= N) versine[k - 2] = Number(k / 2 % 2 ? 1.0 : -1.0) / Number(factorial);
  }
  this->expect_reduced(sin(t) / t, sinc, 1);
  this->expect_reduced((1.0 - cos(t)) / (t * t), versine, 2);
}

TYPED_TEST(CommonPower, OfARootIsTakenOut) {
  const auto& t = this->t;
  this->expect_reduced(sqrt(t * t + t * t * t), t * sqrt(1.0 + t), 1);
  this->expect_reduced(sqrt(pow(t, 6) * exp(t)), pow(t, 3) * exp(t / 2.0), 3);
  EXPECT_EQ(sqrt(t * t + t * t * t)[3], -1.0 / 8.0);
}

TYPED_TEST(CommonPower, OfARealPowerIsTakenOut) {
  const auto& t = this->t;
  const auto u = 1.0 + t;
  this->expect_reduced(pow(t * t * u, 0.5), t * pow(u, 0.5), 1);
  this->expect_reduced(pow(t * t * u, 1.5), pow(t, 3) * pow(u, 1.5),
                       0);  // nothing is lost: t^3 has gained one
  this->expect_reduced(pow(pow(t, 4) * u, 0.25), t * pow(u, 0.25), 3);
  this->expect_reduced(pow(pow(t, 4) * u, 0.75), pow(t, 3) * pow(u, 0.75), 1);
  this->expect_reduced(pow(pow(t, 4) * u, 2.5), 0.0 * t, 0);  // t^10
}

TYPED_TEST(CommonPower, OfTheZeroSeriesIsThatOfTheFirstTermNotKnown) {
  // u = O(t^9): u^a = O(t^{9a}) is zero below that
  const TypeParam zero = 0.0 * this->t;
  this->expect_reduced(pow(zero, 1.5), zero, 0);
  this->expect_reduced(pow(zero, 3), zero, 0);
  EXPECT_EQ(pow(zero, 0), TypeParam(1.0));
  this->expect_reduced(sqrt(zero), zero, N - 4);       // O(t^4.5)
  this->expect_reduced(pow(zero, 0.25), zero, N - 2);  // O(t^2.25)
}

TEST(CommonPower, OfAConstantZeroIsAll) {  // a dynamic jet made from the number 0 has all coefficients 0
  using D = Jet<double, Dynamic>;
  EXPECT_EQ(sqrt(D(0.0)), D(0.0));
  EXPECT_EQ(pow(D(0.0), 0.25), D(0.0));
  EXPECT_EQ(known_degree(pow(D(0.0), -0.5)), -1);
  EXPECT_EQ(known_degree(D(0.0) / D(0.0)), -1);
}

TEST(CommonPower, IsNotTakenFromAnExponentThatMissesIt) {  // 3 a is not 1 for the double next to 1/3
  using D = Jet<double, Dynamic>;
  const D t = D::variable(0.0, N);
  EXPECT_EQ(known_degree(pow(pow(t, 3), 1.0 / 3.0)), 0);
  EXPECT_EQ(known_degree(pow(D(1.0) * pow(D::variable(0.0, 12), 10), 0.1)),
            0);  // the double 0.1 is above 1/10
}

TEST(CommonPower, IsFoundForExponentsOfAnyNumberType) {
  using D = Jet<Digits50, Dynamic>;
  const D t = D::variable(0, N), exponent(Digits50(1.5));
  EXPECT_THAT(pow(t * t + t * t * t, exponent), IsCloseTo(t * t * t * pow(1 + t, exponent), ulps(4)));
}

TEST(CommonPower, OfFractionsIsExact) {  // numbers without NaN lose coefficients in a dynamic jet only
  using Fraction = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                                 boost::multiprecision::et_off>;
  using D = Jet<Fraction, Dynamic>;
  const D t = D::variable(0, 4);
  EXPECT_EQ(t * (3 + t) / (t * (1 - t)), D::from({3, 4, 4, 4}));
  using J = Jet<Fraction, 4>;
  EXPECT_THROW(J::variable(0) / J::variable(0), std::domain_error);
}

TEST(Valuation, IsTheOrderOfTheFirstTerm) {
  using J = Jet<double, 4>;
  EXPECT_EQ(valuation(J::from({0, 0, 3})), 2);
  EXPECT_EQ(valuation(J(1.0)), 0);
  EXPECT_EQ(valuation(J(0.0)), 5);
  EXPECT_EQ(valuation(Jet<double, Dynamic>::from({0, 0, 0})), 3);
}

}  // namespace
}  // namespace jetlag::testing::valuation_test
