// SPDX-License-Identifier: MIT
// Jets of complex numbers against Cauchy's integral of the functions of <complex>.
#include "jetlag/series/complex.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "jetlag/series/comparisons.hpp"

namespace jetlag::testing::complex_test {
namespace {

using Z = std::complex<double>;
constexpr int N = 6;
using J = Jet<Z, N>;
using Checked = CheckedJet<Z, N>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Coefficient k is (1/M) sum_m f(z + r w^m) (r w^m)^{-k}, w = exp(2 pi i/M), but for (r/R)^M = 2^-64 where f is analytic
/// to R = 2 r around z. Rounding: 16 eps of the largest |f| on the circle, over r^k.
template <class F>
void expect_cauchy(const J& series, F f, Z z) {
  constexpr int M = 64;
  constexpr double r = 0.125;
  Z sums[N + 1] = {};
  double largest = 0;
  for (int m = 0; m < M; ++m) {
    const Z value = f(z + std::polar(r, 2 * std::numbers::pi * m / M));
    largest = std::max(largest, std::abs(value));
    for (int k = 0; k <= N; ++k)
      sums[k] += value * std::polar(std::pow(r, -k) / M, -2 * std::numbers::pi * m * k / M);
  }
  for (int k = 0; k <= N; ++k)
    EXPECT_LE(std::abs(series[k] - sums[k]), 16 * 0x1p-52 * largest * std::pow(r, -k))
        << "order " << k << " at " << z;
}

/// f is analytic to 1/4 around each of these.
template <class F>
void expect_cauchy(F f) {
  for (const Z z :
       {Z(0.3, 0.7), Z(-0.6, 0.5), Z(0.5, -0.4), Z(-0.4, -1.5), Z(2.0, 0.5), Z(-2.0, -0.5), Z(0.4, 2.0)})
    expect_cauchy(f(J::variable(z)), [&](const Z& x) { return f(x); }, z);
}

TEST(ComplexJet, HasTheFunctionsOfComplexNumbers) {
  expect_cauchy([](const auto& z) { return exp(z); });
  expect_cauchy([](const auto& z) { return log(z); });
  expect_cauchy([](const auto& z) { return log10(z); });
  expect_cauchy([](const auto& z) { return sqrt(z); });
  expect_cauchy([](const auto& z) { return sin(z); });
  expect_cauchy([](const auto& z) { return cos(z); });
  expect_cauchy([](const auto& z) { return sinh(z); });
  expect_cauchy([](const auto& z) { return cosh(z); });
  expect_cauchy([](const auto& z) { return asin(z); });
  expect_cauchy([](const auto& z) { return acos(z); });
  expect_cauchy([](const auto& z) { return atan(z); });
  expect_cauchy([](const auto& z) { return asinh(z); });
  expect_cauchy([](const auto& z) { return acosh(z); });
  expect_cauchy([](const auto& z) { return atanh(z); });
  expect_cauchy([](const auto& z) { return tan(z / 2.0); });   // poles at +-pi
  expect_cauchy([](const auto& z) { return tanh(z / 2.0); });  // and +-i pi
}

TEST(ComplexJet, HasPowers) {
  const Z a(0.7, -1.2);
  expect_cauchy([](const auto& z) { return pow(z, 2.5); });
  expect_cauchy([](const auto& z) { return pow(z, 3); });
  expect_cauchy([](const auto& z) { return pow(z, -2.0); });
  expect_cauchy([&](const auto& z) { return pow(z, a); });
  expect_cauchy([&](const auto& z) { return pow(a, z); });
  expect_cauchy([](const auto& z) { return pow(2.0, z); });
  expect_cauchy([](const auto& z) { return pow(z, z); });
  EXPECT_EQ(pow(J::variable(0.0), Z(3.0)), pow(J::variable(0.0), 3));
}

TEST(ComplexJet, HasArithmetic) {
  const Z a(0.7, -1.2);
  expect_cauchy([&](const auto& z) { return (z * z + a) / (z * 2.0 - a * 4.0) - 1.0 / (z + 5.0); });
  EXPECT_EQ(derivative(J::variable(a) * J::variable(a))[0], 2.0 * a);
}

TEST(ComplexJet, OfRealCoefficientsIsTheRealJet) {
  const auto real_series = exp(sin(Jet<double, N>::variable(0.4)));
  const J series = exp(sin(J::variable(0.4)));
  for (int k = 0; k <= N; ++k) EXPECT_NEAR(std::abs(series[k] - real_series[k]), 0, 0x1p-49) << k;
}

TEST(ComplexJet, OnABranchCutIsOnTheSideOfItsValue) {
  // The inverse functions are inverse there: f(v) = u. Above and below the cuts, as the sign of zero says.
  for (const double zero : {0.0, -0.0})
    for (const double x : {2.0, -2.0}) {
      const J u = J::variable(Z(x, zero)), v = J::variable(Z(zero, x)), w = J::variable(Z(x / 4 - 1, zero));
      const auto expect_near = [&](const J& a, const J& b) {
        for (int k = 0; k <= N; ++k)
          EXPECT_NEAR(std::abs(a[k] - b[k]), 0, 0x1p-46) << k << ", " << x << ", " << zero;
      };
      expect_near(sin(asin(u)), u);
      expect_near(cos(acos(u)), u);
      expect_near(tanh(atanh(u)), u);
      expect_near(sinh(asinh(v)), v);
      expect_near(tan(atan(v)), v);
      expect_near(cosh(acosh(w)), w);
      expect_near(sqrt(w) * sqrt(w), w);
    }
}

TEST(ComplexJet, KnowsWhatIsNotFinite) {
  const J t = J::variable(0.0);
  EXPECT_EQ(known_degree(1.0 / t), -1);
  EXPECT_EQ(known_degree(J::from({1.0, Z(1, nan)})), 0);
  EXPECT_EQ(known_degree(sin(t) / t), N - 1);
  EXPECT_EQ(known_degree(sqrt(t)), 0);
  EXPECT_TRUE(isfinite(exp(t)));
  EXPECT_FALSE(isfinite(log(t)));
  EXPECT_TRUE(isnan(J(Z(0, nan))));
  EXPECT_FALSE(isnan(t));
}

TEST(ComplexJet, IsCheckedIfItShallBe) {
  const Checked t = Checked::variable(0.0);
  EXPECT_THROW(1.0 / t, SingularPoint);
  EXPECT_THROW(log(t), SingularPoint);
  EXPECT_THROW(asin(1.0 + t), SingularPoint);
  EXPECT_THROW(atan(t + Z(0, 1)), SingularPoint);
  EXPECT_EQ(known_degree(log(t - 1.0)), N);  // i pi - t - ...
}

TEST(ComplexJet, HasPartsAndAConjugate) {  // exp(i t) = cos(t) + i sin(t)
  const J e = exp(Z(0, 1) * J::variable(0.0));
  const auto t = Jet<double, N>::variable(0.0);
  for (int k = 0; k <= N; ++k) {
    EXPECT_DOUBLE_EQ(real(e)[k], cos(t)[k]);
    EXPECT_DOUBLE_EQ(imag(e)[k], sin(t)[k]);
    EXPECT_EQ(conj(e)[k], std::conj(e[k]));
  }
}

template <class S>
concept HasAbs = requires(const S& u) { abs(u); };
template <class S>
concept HasArg = requires(const S& u) { arg(u); };
template <class S>
concept HasNorm = requires(const S& u) { norm(u); };
template <class S>
concept HasOrder = requires(const S& u) { u < u; };
static_assert(!HasAbs<J> && !HasArg<J> && !HasNorm<J> && !HasOrder<J>);  // not analytic
static_assert(HasAbs<Jet<double, N>> && HasOrder<Jet<double, N>>);

}  // namespace
}  // namespace jetlag::testing::complex_test
