// SPDX-License-Identifier: MIT
// Functions where a careless formula cancels, overflows or loses all digits.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/factorials.hpp>
#include <boost/math/special_functions/hermite.hpp>
#include <cmath>
#include <limits>

#include "jetlag/series/elementary.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing::extreme_points_test {
namespace {

using D = Digits100;
using J = Jet<double, 8>;
const J t = J::variable(0.0);

/// Each coefficient to 16 units of its own last place: at most two roundings an order, twice that for what is carried.
template <class E>
void expect_digits(const J& actual, E expected) {
  for (int k = 0; k <= J::degree; ++k) {
    const D truth = expected(k);
    EXPECT_LE(abs(D(actual[k]) - truth), 16 * D(std::numeric_limits<double>::epsilon()) * abs(truth))
        << "coefficient " << k << " is " << actual[k] << " instead of " << truth;
  }
}

TEST(NearZero, Expm1AndLog1pKeepTheirArgument) {
  EXPECT_EQ(expm1(1e-16 + t)[0], 1e-16);
  EXPECT_EQ(log1p(1e-16 + t)[0], 1e-16);
  EXPECT_EQ(asinh(1e-16 + t)[0], 1e-16);
  EXPECT_EQ(atanh(1e-16 + t)[0], 1e-16);
  EXPECT_EQ(tanh(1e-16 + t)[0], 1e-16);
}

TEST(FarBelowZero, Expm1HasTheDerivativesOfExp) {  // 1 + expm1(-40) is 0 in double
  expect_digits(expm1(t - 40.0), [](int k) {
    return D((k == 0 ? expm1(D(-40)) : exp(D(-40))) / boost::math::factorial<D>(k));
  });
}

TEST(FarFromZero,
     TanhHasTheDerivativeOfItsTail) {  // tanh(x) = 1 - 2 e^{-2x} + 2 e^{-4x}: the last term is 1e-70
  for (const double s : {1.0, -1.0})
    expect_digits(tanh(s * (40.0 + t)), [&](int k) {
      const D tail = -2 * exp(D(-80)) * pow(D(-2), k) / boost::math::factorial<D>(k);
      return D(s * (k == 0 ? 1 + tail : tail));
    });
}

TEST(FarFromZero, ErfcHasItsDigits) {
  for (const double x : {2.1, 10.1, 25.1})
    expect_digits(erfc(x + t), [&](int k) -> D {  // DLMF 7.10.1; x^2 is not exact
      if (k == 0) return erfc(D(x));
      const D bell = 2 / sqrt(boost::math::constants::pi<D>()) * exp(-D(x) * x);
      return (k % 2 ? -1 : 1) * boost::math::hermite(k - 1, D(x)) * bell / boost::math::factorial<D>(k);
    });
  EXPECT_EQ(erfc(40.0 + t), J(0.0));  // e^{-1600} is below all doubles
  EXPECT_EQ(erf(40.0 + t), J(1.0));
}

TEST(NearOne, AtanhHasItsDigits) {
  const double x = 1.0 - 0x1p-40;
  expect_digits(atanh(x + t), [&](int k) -> D {  // half of log(1 + x) - log(1 - x)
    if (k == 0) return atanh(D(x));
    return ((k % 2 ? 1 : -1) / pow(1 + D(x), k) + 1 / pow(1 - D(x), k)) / (2 * k);
  });
}

/// Coefficient k of (1 - s (x + t)^2)^(-1/2) by the binomial series in each of the factors 1 -+ (x + t), for s = 1; of
/// ((x + t)^2 - 1)^(-1/2) for s = -1.
D inverse_root_coefficient(const D& x, int k, int s) {
  const auto binomial = [](int j) {  // C(-1/2, j)
    D product = 1;
    for (int i = 0; i < j; ++i) product *= (D(-0.5) - i) / (i + 1);
    return product;
  };
  const D a = s * (1 - x), b = 1 + x;
  D sum = 0;
  for (int j = 0; j <= k; ++j) sum += binomial(j) * pow(-s / a, j) * binomial(k - j) * pow(1 / b, k - j);
  return sum / sqrt(a * b);
}

TEST(NearOne, AsinAndAcosHaveTheirDigits) {
  for (const double x : {1.0 - 0x1p-40, -1.0 + 0x1p-40}) {
    const auto tail = [&](int k) { return D(inverse_root_coefficient(x, k - 1, 1) / k); };
    expect_digits(asin(x + t), [&](int k) { return k == 0 ? D(asin(D(x))) : tail(k); });
    expect_digits(acos(x + t), [&](int k) { return k == 0 ? D(acos(D(x))) : D(-tail(k)); });
  }
}

TEST(NearOne, AcoshHasItsDigits) {
  const double x = 1.0 + 0x1p-40;
  expect_digits(acosh(x + t), [&](int k) {
    return k == 0 ? D(acosh(D(x))) : D(inverse_root_coefficient(x, k - 1, -1) / k);
  });
}

TEST(Logarithms, OfPowersOfTheirBaseAreWhole) {
  EXPECT_EQ(log2(8.0 + t)[0], 3.0);
  EXPECT_EQ(log10(1000.0 + t)[0], 3.0);
}

// ---- very large and very small numbers -------------------------------------------------------------------

TEST(Hypot, ScalesWithoutRounding) {  // by powers of two, where the squares overflow or vanish: the same bits
  const J x = J::from({3, 1, -2, 0.5, 7, 1, 1, -1, 0.25}), y = J::from({-4, 2, 5, -1, 0.5, 3, -6, 1, 2});
  for (const int exponent : {-600, 600, 1000}) {
    const double s = std::ldexp(1.0, exponent);
    EXPECT_EQ(hypot(s * x, s * y), s * hypot(x, y)) << exponent;
    EXPECT_EQ(hypot(s * x, s * 4), s * hypot(x, 4)) << exponent;
    EXPECT_EQ(atan2(s * y, s * x), atan2(y, x)) << exponent;
    EXPECT_EQ(atan2(s * y, s * 3), atan2(y, 3)) << exponent;
    EXPECT_EQ(atan2(s * -4, s * x), atan2(-4, x)) << exponent;
  }
  EXPECT_EQ(hypot(1e200 + t, 1.0)[0], 1e200);
  EXPECT_EQ(hypot(1e200 + t, 1.0)[1], 1.0);
}

TEST(AreaFunctions, OfLargeNumbersAreLogarithms) {  // asinh(x) = log(2x) + O(x^-2)
  const double x = std::ldexp(1.0, 700);
  const auto expected = [&](int k) {
    return k == 0 ? D(log(2 * D(x))) : D((k % 2 ? 1 : -1) / D(k));  // of log(x (1 + t)) = log(x) + log(1 + t)
  };
  expect_digits(asinh(x * (1.0 + t)), expected);
  expect_digits(acosh(x * (1.0 + t)), expected);
}

TEST(Atan, OfLargeNumbersIsARightAngle) {
  const J v = atan(1e150 + t);
  EXPECT_EQ(v[0], std::acos(0.0));
  EXPECT_DOUBLE_EQ(v[1], 1e-300);
  for (int k = 2; k <= J::degree; ++k) EXPECT_EQ(v[k], 0.0);  // below 1e-450
}

}  // namespace
}  // namespace jetlag::testing::extreme_points_test
