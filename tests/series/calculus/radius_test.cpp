// SPDX-License-Identifier: MIT
// Estimates of the radius of convergence and of the tail, against functions whose singularities are known.
#include "jetlag/series/calculus/radius.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing::radius_test {
namespace {

constexpr int degree = 30;
using J = Jet<double, degree>;
const J t = J::variable(0.0);
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A name, a series like (1 - (t/R)^d)^{-a}, whose singularities are at the distance R.
struct Known {
  const char* name;
  J series;
  double a;
  int d;
};
std::vector<Known> singular_functions(double R) {
  const J x = t / R;
  return {{"1/(1-x)", 1.0 / (1.0 - x), 1, 1},           {"1/(1+x)", 1.0 / (1.0 + x), 1, 1},
          {"1/(1-x)^3", pow(1.0 - x, -3), 3, 1},        {"sqrt(1-x)", sqrt(1.0 - x), -0.5, 1},
          {"1/sqrt(1+x)", 1.0 / sqrt(1.0 + x), 0.5, 1}, {"log(1-x)", log(1.0 - x), 0, 1},
          {"1/(1+x^2)", 1.0 / (1.0 + x * x), 1, 2},     {"x/(1+x^2)", x / (1.0 + x * x), 1, 2},
          {"sqrt(1-x^2)", sqrt(1.0 - x * x), -0.5, 2},  {"1/(1-x^3)", 1.0 / (1.0 - x * x * x), 1, 3}};
}
const std::vector<double> radii{1.0, 0.003, 250.0};

TEST(RadiusByRatio, ErrsByTheExponentOverTheDegree) {  // of t^d: R n/(n + a - 1)
  for (const double R : radii)
    for (const auto& f : singular_functions(R)) {
      const double error = std::abs(f.a - 1) / (degree / f.d - 2);
      EXPECT_NEAR(radius_by_ratio(f.series), R, R * (error + 1e-14)) << f.name;
    }
}

TEST(RadiusByRatio, IsTheRatio) {  // n/(n + a - 1)
  EXPECT_NEAR(radius_by_ratio(sqrt(1.0 - t)), 30.0 / 28.5, 1e-14);
  EXPECT_NEAR(radius_by_ratio(pow(1.0 - t, -3)), 30.0 / 32.0, 1e-14);
  EXPECT_NEAR(radius_by_ratio(exp(t)), 30.0, 1e-12);
}

TEST(RadiusByThreeTerms, IsExactForAlgebraicSingularitiesOnTheAxes) {
  // r_n carries the rounding errors of two coefficients, n of them at most, and is multiplied by n
  for (const double R : radii)
    for (const auto& f : singular_functions(R)) {
      const double eps = std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(radius_by_three_terms(f.series), R, R * 2 * degree * degree * eps) << f.name;
    }
}

TEST(RadiusByRoot, ErrsByTheLogarithmOfTheDegreeOverTheDegree) {  // (|u_l|/c)^{1/n} n^{(1-a)/n}, |ln c| < 3
  for (const double R : radii)
    for (const auto& f : singular_functions(R)) {
      const double n = degree / 2 - 1, error = (std::abs(f.a - 1) * std::log(n) + 3) / n;
      for (const double estimate : {radius_by_root(f.series), radius_by_last_two(f.series, 1.0)}) {
        EXPECT_LT(estimate, R * std::exp(error)) << f.name;
        EXPECT_GT(estimate, R * std::exp(-error)) << f.name;
      }
    }
}

TEST(RadiusByLastTwo, IsExactForAGeometricSeriesOfItsScale) {  // even ones too: u_{N-1} = 0
  for (const double R : radii) {
    EXPECT_NEAR(radius_by_last_two(7.0 / (1.0 - t / R), 7.0), R, R * 1e-14);
    EXPECT_NEAR(radius_by_last_two(-7.0 / (1.0 + square(t / R)), 7.0), R, R * 1e-14);
    EXPECT_NEAR(radius_by_last_two(7.0 / (1.0 - t / R), 7.0 * std::pow(2.0, degree)), 2 * R, R * 1e-13);
  }
}

TEST(RadiusByRoot, SurvivesSingularitiesOffTheAxes) {
  // 1/(1 - 2 cos(1) t + t^2): u_n = sin(n + 1)/sin(1). Within (ln(1/sin 1) + ln 4)/15, as one |sin| of two is > 1/4.
  const J u = 1.0 / (1.0 - 2 * std::cos(1.0) * t + t * t);
  EXPECT_NEAR(std::log(radius_by_root(u)), 0.0, std::log(4 / std::sin(1.0)) / 15);
  EXPECT_NEAR(std::log(radius_by_last_two(u, 1.0)), 0.0, std::log(4 / std::sin(1.0)) / 15);
}

TEST(Radius, OfAnEntireFunctionGrowsOrIsInfinite) {
  using J60 = Jet<double, 60>;
  const J60 s = J60::variable(0.0);
  const auto expect_growth = [](const auto& less, const auto& more) {
    EXPECT_GT(radius_by_ratio(more), 1.9 * radius_by_ratio(less));
    EXPECT_GT(radius_by_root(more), 1.7 * radius_by_root(less));  // (n!)^{1/n} = n/e (2 pi n)^{1/2n}
    EXPECT_GT(radius_by_last_two(more, 1.0), 1.7 * radius_by_last_two(less, 1.0));
    EXPECT_GT(radius_by_three_terms(more), radius_by_three_terms(less) * 1.9);
  };
  expect_growth(sin(t), sin(s));
  expect_growth(cos(t), cos(s));
  EXPECT_EQ(radius_by_three_terms(exp(t)), infinity);
  EXPECT_EQ(radius_by_three_terms(exp(-3 * s)), infinity);
}

/// All four estimates of a series.
template <class S>
std::array<double, 4> estimates(const S& u) {
  return {static_cast<double>(radius_by_ratio(u)), static_cast<double>(radius_by_root(u)),
          static_cast<double>(radius_by_last_two(u, jetlag::detail::ValueOf<S>(1))),
          static_cast<double>(radius_by_three_terms(u))};
}

TEST(Radius, OfASeriesThatHasEndedIsInfinite) {
  using ::testing::Each;
  for (const auto& u : {J(0.0), J(3.0), t, 1.0 + t * t * t, -pow(t, degree - 2)})
    EXPECT_THAT(estimates(u), Each(infinity));
  for (const auto& u : {std::vector<double>{}, std::vector<double>{0}, {4}, {0, 0}, {4, 0, 0}})
    EXPECT_THAT(estimates(u), Each(infinity));
}

TEST(Radius, OfShortSeriesIsANumber) {
  EXPECT_NEAR(radius_by_ratio(std::vector<double>{6, 3}), 2.0, 1e-15);
  EXPECT_NEAR(radius_by_root(std::vector<double>{6, 3}), 2.0, 1e-15);
  EXPECT_NEAR(radius_by_last_two(std::vector<double>{6, 3}, 6.0), 2.0, 1e-15);
  EXPECT_NEAR(radius_by_three_terms(std::vector<double>{6, 3}), 2.0, 1e-15);  // no three terms: the ratio
  for (const auto& u : {std::vector<double>{0, 3}, {0, 0, 3}, {0, 3, 0, 2}, {1, 0, 3}})
    for (const double R : estimates(u)) EXPECT_GT(R, 0.0);
}

TEST(Radius, OfASeriesThatIsNotFiniteIsZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(estimates(sqrt(t)), ::testing::Each(0.0));
  EXPECT_THAT(estimates(std::vector<double>{1, 1, nan, 1, 1}), ::testing::Each(0.0));
}

TEST(Radius, DoesNotDependOnTheUnitOfTheSeries) {  // 300 orders of magnitude; logarithms of 700 lose 3 digits
  for (const auto& f : singular_functions(1.0))
    for (const double unit : {1e-300, 1e290}) {
      EXPECT_NEAR(radius_by_ratio(unit * f.series), radius_by_ratio(f.series), 1e-12) << f.name;
      EXPECT_NEAR(radius_by_root(unit * f.series), radius_by_root(f.series), 1e-12) << f.name;
      EXPECT_NEAR(radius_by_last_two(unit * f.series, unit), radius_by_last_two(f.series, 1.0), 1e-12)
          << f.name;
      EXPECT_NEAR(radius_by_three_terms(unit * f.series), 1.0, 1e-12) << f.name;
    }
}

TEST(Radius, IsOfAnyNumberTypeAndContainer) {
  EXPECT_NEAR(radius_by_ratio(std::array<float, 3>{1, 2, 4}), 0.5F, 1e-6F);
  std::vector<Digits50> u;
  for (int k = 0; k <= 20; ++k) u.push_back(pow(Digits50(3), k));
  for (const double R : estimates(u)) EXPECT_NEAR(R, 1.0 / 3, 1e-15);
}

// ---- what lies beyond the last coefficient -------------------------------------------------------------------

/// sum_{n>N} u_n h^n of a function f in 50 digits: by 400 coefficients, which h < 0.8 R leaves 1e-38.
template <class F>
double true_tail(F f, double h) {
  using Long = Jet<Digits50, 400>;
  static Long u;
  u = f(Long::variable(Digits50(0)));
  for (int k = 0; k <= degree; ++k) u[k] = Digits50(0);
  return static_cast<double>(abs(u(Digits50(h))));
}

/// The tail at some fractions of the estimated radius R.
template <class F>
void expect_bounded_tail(F f, const char* name) {
  const J u = f(t);
  const double R = std::min(radius_by_three_terms(u), radius_by_ratio(u));
  for (const double fraction : {0.01, 0.1, 0.3, 0.5, 0.75}) {
    const double h = fraction * R, tail = true_tail(f, h), bound = tail_bound(u, h, R);
    EXPECT_GE(bound * (1 + 1e-12), tail) << name << " at h/R = " << fraction;
    EXPECT_LE(bound, 4 / fraction / (1 - fraction) * tail) << name << " at h/R = " << fraction;
  }
}

TEST(TailBound, HoldsForFunctionsInClosedForm) {  // |u_n| R^n falls for all of them: it is a bound
  expect_bounded_tail([](const auto& x) { return 1.0 / (1.0 - x); }, "1/(1-x)");
  expect_bounded_tail([](const auto& x) { return 1.0 / (1.0 + x * x); }, "1/(1+x^2)");
  expect_bounded_tail([](const auto& x) { return sqrt(1.0 - x); }, "sqrt(1-x)");
  expect_bounded_tail([](const auto& x) { return log(1.0 + x / 3.0); }, "log(1+x/3)");
  expect_bounded_tail([](const auto& x) { return pow(1.0 - x, -3); }, "1/(1-x)^3");
  expect_bounded_tail([](const auto& x) { return exp(x); }, "exp");
  expect_bounded_tail([](const auto& x) { return sin(x); }, "sin");
}

TEST(TailBound, IsTheTailOfAGeometricSeries) {
  for (const double h : {0.1, 0.5, 0.9})
    EXPECT_NEAR(tail_bound(7.0 / (1.0 - t), h, 1.0), 7.0 * std::pow(h, degree + 1) / (1 - h),
                1e-13 * std::pow(h, 30));
}

TEST(TailBound, HasItsEnds) {
  const J u = 1.0 / (1.0 - t);
  EXPECT_EQ(tail_bound(u, 0.0, 1.0), 0.0);
  EXPECT_EQ(tail_bound(u, 1.0, 1.0), infinity);
  EXPECT_EQ(tail_bound(1.0 + t, 100.0, infinity), 0.0);
  EXPECT_NEAR(tail_bound(1e-300 / (1.0 - t), 0.5, 1.0), 1e-300 * 0x1p-30, 1e-320);
  EXPECT_THROW(tail_bound(u, -0.1, 1.0), std::invalid_argument);
  EXPECT_THROW(tail_bound(u, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(tail_bound(u, 0.1, infinity), std::invalid_argument);
  EXPECT_THROW(tail_bound(u, 0.1, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::radius_test
