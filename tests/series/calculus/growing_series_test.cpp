// SPDX-License-Identifier: MIT
// Growing series have the coefficients of jets, one order at a time.
#include "jetlag/series/calculus/growing_series.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "jetlag/series/comparisons.hpp"
#include "support/close.hpp"
#include "support/counted.hpp"
#include "support/digits50.hpp"
#include "support/running_error.hpp"

namespace jetlag::testing {
namespace {

/// Every kind of operation.
const auto expression = [](const auto& x) {
  const auto s = sin(x) + 1.5;
  return exp(s / 2.0) * sqrt(s) - log(s) * pow(s, -1.25) + 3.0 / (cos(x) + x * x) - pow(x, 3) / s +
         0.25 * square(-x) - (1.0 - x);
};

TEST(GrowingSeries, HasTheBitsOfAJet) {
  const auto jet = expression(Jet<double, 30>::variable(0.75));
  const auto series = expression(GrowingSeries<double>::variable(0.75));
  for (int k = 0; k <= 30; ++k) EXPECT_EQ(series[k], jet[k]) << k;
}

TEST(GrowingSeries, TakesEveryFunction) {
  const auto f = [](const auto& x) {
    return asin(x / 4.0) - acos(x / 4.0) * atan(x) + tan(x) * sinh(x) - cosh(x) / tanh(x) + asinh(x) +
           acosh(x + 1.0) + atanh(x / 4.0) + hypot(x, 2.0 - x) * atan2(x, 2.0) - atan2(x * x, x) +
           cbrt(x) * expm1(x) - log1p(x) + log2(x) * log10(x) + erf(x) - erfc(2.0 * x) + pow(2.0, x) +
           abs(x) - min(x, 1.0) * max(x, 1.0 - x);
  };
  const auto jet = f(Jet<double, 20>::variable(0.75));
  const auto series = f(GrowingSeries<double>::variable(0.75));
  for (int k = 0; k <= 20; ++k) EXPECT_EQ(series[k], jet[k]) << k;
}

TEST(GrowingSeries, ComputesACoefficientWhenItIsAskedFor) {
  const auto series = expression(GrowingSeries<double>::variable(0.75));
  EXPECT_EQ(series.size(), 0);
  const double late = series[12];
  EXPECT_EQ(series.size(), 13);
  const auto again = expression(GrowingSeries<double>::variable(0.75));
  for (int k = 0; k < 12; ++k) again[k];
  EXPECT_EQ(again[12], late);
}

TEST(GrowingSeries, PaysForOneMoreOrderOnly) {  // linear in the order, so that K orders cost K^2
  const auto series = expression(GrowingSeries<Counted>::variable(0.75));
  const auto products = [&](int k) {
    series[k - 1];
    const auto before = Counted::products;
    series[k];
    return Counted::products - before;
  };
  const auto at_32 = products(32), at_64 = products(64), at_128 = products(128);
  EXPECT_LE(at_64, 2 * at_32);
  EXPECT_LE(at_128, 2 * at_64);
  EXPECT_EQ(products(128), 0);  // it is kept
}

TEST(GrowingSeries, SharesWhatItsCopiesHaveComputed) {
  const auto series = exp(GrowingSeries<double>::variable(0.5)), copy = series;
  series[9];
  EXPECT_EQ(copy.size(), 10);
}

TEST(GrowingSeries, OutlivesItsOperands) {
  GrowingSeries<double> cosine = 0.0;
  {
    const auto x = GrowingSeries<double>::variable(0.3);
    cosine = cos(x * 2.0);
  }
  EXPECT_EQ(cosine[7], cos(Jet<double, 7>::variable(0.3) * 2.0)[7]);
}

TEST(GrowingSeries, SolvesInitialValueProblems) {  // closed forms
  using Number = RunningError<double>;
  using S = GrowingSeries<Number>;
  const auto solve = [](S x, const S& f) {
    for (int k = 0; k < 15; ++k) x.append(f[k] / Number(k + 1));
    return x;
  };
  const S y = S::given({Number(1.0)});  // y' = y
  const S e = solve(y, y * 1.0);
  const S z = S::given({Number(0.75)});  // z' = z^2: z = z_0 / (1 - z_0 t)
  const S pole = solve(z, square(z));
  const S w = S::given({Number(0.0)});  // w' = 1 + w^2: the tangent
  const S tangent = solve(w, 1.0 + w * w);
  Digits50 factorial = 1;
  for (int k = 0; k <= 15; ++k) {
    if (k > 0) factorial *= k;
    EXPECT_THAT(e[k], IsCloseTo(1 / factorial)) << k;
    EXPECT_THAT(pole[k], IsCloseTo(pow(Digits50(0.75), k + 1))) << k;
  }
  EXPECT_THAT(tangent[7], IsCloseTo(Digits50(17) / 315));
  EXPECT_THAT(tangent[13], IsCloseTo(Digits50(21844) / 6081075));
}

TEST(GrowingSeries, SaysWhichCoefficientIsMissing) {
  auto x = GrowingSeries<double>::given({1.0, 2.0});
  const auto v = exp(x);
  EXPECT_EQ(v.size(), 0);
  EXPECT_EQ(v[1], 2.0 * std::exp(1.0));
  try {
    v[2];
    FAIL() << "nothing is thrown";
  } catch (const std::out_of_range& e) {
    EXPECT_STREQ(e.what(), "GrowingSeries: coefficient 2 has not been given");
  }
  x.append(0.5);  // and then it is there
  EXPECT_EQ(v[2], exp(Jet<double, 2>::from({1, 2, 0.5}))[2]);
  auto constant = GrowingSeries<double>(1.0);
  EXPECT_THROW(constant.append(1.0), std::logic_error);
}

TEST(GrowingSeries, OfAPolynomialEnds) {
  const auto u = GrowingSeries<double>::polynomial({1, 2, 3});
  EXPECT_EQ(u[2], 3.0);
  EXPECT_EQ(u[9], 0.0);
  EXPECT_EQ((u * u)[4], 9.0);
  EXPECT_EQ((u * u)[5], 0.0);
}

}  // namespace
}  // namespace jetlag::testing
