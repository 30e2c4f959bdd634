// SPDX-License-Identifier: MIT
// Composition and reversion of series.
#include "jetlag/series/calculus/composition.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/factorials.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing::composition_test {
namespace {

using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
template <int N>
using Tracked = Jet<RunningError<double>, N>;

Rational factorial(int n) { return n < 2 ? Rational(1) : n * factorial(n - 1); }

/// Exact coefficients 0, ..., 12 of a formula in k.
std::vector<Rational> series(auto f) {
  std::vector<Rational> u;
  for (int k = 0; k <= 12; ++k) u.push_back(f(k));
  return u;
}
const auto t = series([](int k) { return Rational(k == 1); });
const auto sine = series([](int k) { return k % 2 ? (k / 2 % 2 ? -1 : 1) / factorial(k) : Rational(0); });
const auto exp_minus_1 = series([](int k) { return k ? 1 / factorial(k) : Rational(0); });
const auto log_1_plus = series([](int k) { return k ? Rational(k % 2 ? 1 : -1, k) : Rational(0); });

// ---- composition ---------------------------------------------------------------------------------------------

TEST(Compose, OfExpAndLogIsTheIdentity) {
  EXPECT_EQ(compose(exp_minus_1, log_1_plus), t);
  EXPECT_EQ(compose(log_1_plus, exp_minus_1), t);
}

TEST(Compose, OfExpAndAPowerSpreadsTheCoefficients) {  // exp(t^3) = sum t^{3n}/n!
  const auto cube = series([](int k) { return Rational(k == 3); });
  EXPECT_EQ(compose(exp_minus_1, cube),
            series([](int k) { return k % 3 || k == 0 ? Rational(0) : 1 / factorial(k / 3); }));
}

TEST(Compose, IsAssociative) {
  const auto v = series([](int k) { return Rational(k ? k + 1 : 0, 7); });
  EXPECT_EQ(compose(compose(sine, v), exp_minus_1), compose(sine, compose(v, exp_minus_1)));
}

TEST(Compose, OfAPolynomialIsExactAwayFromTheOriginToo) {  // 1 + 2v + 3v^2 at v = 5 + t
  const std::vector<double> u{1, 2, 3};
  EXPECT_EQ(compose(u, std::array<double, 4>{5, 1, 0, 0}), (std::array<double, 4>{86, 32, 3, 0}));
}

TEST(Compose, LeavesNoMoreCoefficientsThanTheInnerSeriesHas) {
  EXPECT_EQ(compose(exp_minus_1, std::vector<Rational>{0, 2}), (std::vector<Rational>{0, 2}));
  EXPECT_EQ(compose(exp_minus_1, std::vector<Rational>{}), std::vector<Rational>{});
  EXPECT_EQ(compose(std::vector<Rational>{}, t), std::vector<Rational>(13));
}

TEST(Compose, IsWhatAJetOfAJetIs) {
  Uniform draw(5);
  Tracked<10> u, v;
  for (int k = 0; k <= 10; ++k) {
    u[k] = draw(-1, 1);
    v[k] = draw(-1, 1);
  }
  EXPECT_THAT(compose(u, v), IsCloseTo(u(v)));
  v[0] = 0.0;
  EXPECT_THAT(compose(u, v), IsCloseTo(u(v)));
}

TEST(Compose, OfASeriesAboutTheInnerValueIsTheFunction) {  // as the docstring advises where v_0 != 0
  auto v = sin(Tracked<10>::variable(0.6));
  const auto u = exp(Tracked<10>::variable(v[0].value));
  const auto truth = exp(v);
  v[0] = 0.0;
  EXPECT_THAT(compose(u, v), IsCloseTo(truth));
}

// ---- reversion -----------------------------------------------------------------------------------------------

TEST(Revert, OfTExpTHasTheCoefficientsOfLambert) {  // (-n)^{n-1}/n!: W(t), by Lagrange
  const auto u = series([](int k) { return k ? 1 / factorial(k - 1) : Rational(0); });
  EXPECT_EQ(revert(u), series([](int n) {
              boost::multiprecision::cpp_int power = 1;
              for (int i = 1; i < n; ++i) power *= -n;
              return n ? Rational(power) / factorial(n) : Rational(0);
            }));
}

TEST(Revert, OfSineIsArcsine) {  // coefficient 2m+1: (2m)!/(4^m (m!)^2 (2m+1))
  EXPECT_EQ(revert(sine), series([](int k) {
              if (k % 2 == 0) return Rational(0);
              const int m = k / 2;
              return factorial(2 * m) / (boost::multiprecision::cpp_int(1) << (2 * m)) / factorial(m) /
                     factorial(m) / k;
            }));
}

TEST(Revert, OfExpMinus1IsLog) { EXPECT_EQ(revert(exp_minus_1), log_1_plus); }

TEST(Revert, UndoesASeriesFromBothSides) {
  Uniform draw(6);
  const auto u =
      series([&](int k) { return k ? Rational(static_cast<int>(draw(1, 100)), 17) : Rational(0); });
  EXPECT_EQ(compose(u, revert(u)), t);
  EXPECT_EQ(compose(revert(u), u), t);
}

TEST(Revert, OfAJetIsAJet) {
  const auto s = Tracked<15>::variable(0.0);
  EXPECT_THAT(revert(s * exp(s)), HasCoefficients([](int n) {
                return n == 0 ? Digits50(0)
                              : Digits50(pow(Digits50(-n), n - 1) / boost::math::factorial<Digits50>(n));
              }));
}

TEST(Revert, SaysWhyThereIsNoInverse) {
  const auto message = [](const auto& u) -> std::string {
    try {
      revert(u);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message(std::vector<double>{0, 0, 1}), HasSubstr("u_1 must not be 0"));
  EXPECT_THAT(message(std::vector<double>{0, std::numeric_limits<double>::quiet_NaN(), 1}),
              HasSubstr("got nan"));
  EXPECT_THAT(message(std::vector<double>{0.5, 1, 1}), HasSubstr("u_0 must be 0 (remove it first), got 0.5"));
  EXPECT_THAT(message(std::vector<double>{0}), HasSubstr("got 1 coefficients"));
  EXPECT_EQ(message(std::vector<double>{0, 1}), "none");
}

}  // namespace
}  // namespace jetlag::testing::composition_test
