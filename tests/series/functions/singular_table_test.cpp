// SPDX-License-Identifier: MIT
// The table of singular and special points at which other Taylor engines give wrong numbers, to order 4: no row may
// hold a wrong number. Static and dynamic jets; quiet ones are not finite from the first coefficient that does not
// exist, checked ones say so.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/series/comparisons.hpp"
#include "support/close.hpp"

namespace jetlag::testing::singular_table_test {
namespace {

constexpr int N = 4;
using Coefficients = std::vector<double>;

template <class J>
class SingularTable : public ::testing::Test {
 protected:
  static constexpr bool is_dynamic = J::degree_at_compile_time == Dynamic;
  static constexpr bool is_checked = J::singularities == Singularities::checked;

  static J at(double x) {
    if constexpr (is_dynamic)
      return J::variable(x, N);
    else
      return J::variable(x);
  }
  const J t = at(0.0);

  static void expect_coefficients(const J& u, const Coefficients& expected) {
    double largest = 0;
    for (const double c : expected) largest = std::max(largest, std::abs(c));
    for (int k = 0; k < static_cast<int>(expected.size()); ++k)  // the usual tolerance: 4 ulps for each order
      EXPECT_NEAR(u[k], expected[k], 4 * (k + 1) * 0x1p-52 * largest) << "coefficient " << k;
  }

  /// All coefficients exist and are known.
  static void complete(const J& u, const Coefficients& expected) {
    ASSERT_EQ(expected.size(), N + 1u);
    if (!u.is_constant()) {
      EXPECT_EQ(known_degree(u), N);
    }
    expect_coefficients(u, expected);
  }

  /// The series exists, but only these coefficients of it are known. Not an error.
  static void reduced(const J& u, const Coefficients& expected) {
    EXPECT_EQ(known_degree(u), static_cast<int>(expected.size()) - 1);
    EXPECT_EQ(u.degree(), is_dynamic ? static_cast<int>(expected.size()) - 1 : N);
    expect_coefficients(u, expected);
  }

  /// These coefficients exist, the next one does not.
  template <class F>
  static void ends(F f, const Coefficients& expected, const std::string& message) {
    if constexpr (is_checked) {
      try {
        f();
        ADD_FAILURE() << "nothing is thrown instead of " << message;
      } catch (const SingularPoint& e) {
        EXPECT_EQ(e.what(), message);
        EXPECT_EQ(e.order(), static_cast<int>(expected.size()));
      }
    } else {
      const J u = f();
      EXPECT_EQ(known_degree(u), static_cast<int>(expected.size()) - 1) << message;
      for (int k = static_cast<int>(expected.size()); k <= u.degree(); ++k) EXPECT_FALSE(std::isfinite(u[k]));
      expect_coefficients(u, expected);
    }
  }
};
using Jets = ::testing::Types<Jet<double, N>, Jet<double, Dynamic>, CheckedJet<double, N>,
                              CheckedJet<double, Dynamic>>;
struct NameOfJet {
  template <class J>
  static std::string GetName(int) {
    return std::string(J::degree_at_compile_time == Dynamic ? "Dynamic" : "Static") +
           (J::singularities == Singularities::checked ? "Checked" : "");
  }
};
TYPED_TEST_SUITE(SingularTable, Jets, NameOfJet);

// ---- the rows of the table --------------------------------------------------------------------------------

TYPED_TEST(SingularTable, WholePowersAtZero) {
  const auto& t = this->t;
  this->complete(pow(t, 2), {0, 0, 1, 0, 0});
  this->complete(pow(t, 2.0), {0, 0, 1, 0, 0});
  this->complete(pow(t, TypeParam(2.0)), {0, 0, 1, 0, 0});
  this->complete(pow(t, 3), {0, 0, 0, 1, 0});
  this->complete(pow(t, 3.0), {0, 0, 0, 1, 0});
  this->complete(t * t * t, {0, 0, 0, 1, 0});
  this->complete(pow(t, 0), {1, 0, 0, 0, 0});
  this->complete(pow(this->at(-2.0), 3.0), {-8, 12, -6, 1, 0});
}

TYPED_TEST(SingularTable, RootsAndRealPowersAtZero) {
  const auto& t = this->t;
  this->reduced(sqrt(t * t + t * t * t), {0, 1, 0.5, -0.125});
  this->reduced(sqrt(square(t)), {0, 1, 0, 0});
  this->reduced(cbrt(t * t * t + t * t * t * t), {0, 1, 1.0 / 3.0});
  this->complete(pow(t * t, 1.5), {0, 0, 0, 1, 0});
  this->ends([&] { return sqrt(t); }, {0}, "sqrt: coefficient 1 does not exist at u_0 = 0");
  this->ends([&] { return cbrt(t); }, {0}, "cbrt: coefficient 1 does not exist at u_0 = 0");
  this->ends([&] { return cbrt(t * t); }, {0}, "cbrt: coefficient 1 does not exist at u_0 = 0");
  this->ends([&] { return pow(t, 0.5); }, {0}, "power: coefficient 1 does not exist at c = 0.5, u_0 = 0");
  this->ends([&] { return pow(t, 1.5); }, {0, 0}, "power: coefficient 2 does not exist at c = 1.5, u_0 = 0");
  this->ends([&] { return pow(t, 2.5); }, {0, 0, 0},
             "power: coefficient 3 does not exist at c = 2.5, u_0 = 0");
  this->ends([&] { return pow(t, -0.5); }, {}, "power: coefficient 0 does not exist at c = -0.5, u_0 = 0");
  this->ends([&] { return sqrt(t * t * t); }, {0, 0}, "sqrt: coefficient 2 does not exist at u_0 = 0");
  this->ends([&] { return sqrt(t - 1.0); }, {}, "sqrt: coefficient 0 does not exist at u_0 = -1");
  this->ends([&] { return sqrt(-(t * t)); }, {0}, "sqrt: coefficient 1 does not exist at u_0 = 0");
}

TYPED_TEST(SingularTable, LogarithmsAtZero) {
  const auto& t = this->t;
  this->ends([&] { return log(t); }, {}, "log: coefficient 0 does not exist at u_0 = 0");
  this->ends([&] { return log(t - 1.0); }, {}, "log: coefficient 0 does not exist at u_0 = -1");
  this->ends([&] { return log1p(t - 1.0); }, {}, "log1p: coefficient 0 does not exist at u_0 = -1");
  this->ends([&] { return log10(t); }, {}, "log10: coefficient 0 does not exist at u_0 = 0");
  this->ends([&] { return log2(t * t); }, {}, "log2: coefficient 0 does not exist at u_0 = 0");
}

TYPED_TEST(SingularTable, QuotientsByZero) {
  const auto& t = this->t;
  using J = TypeParam;
  this->ends([&] { return 1.0 / t; }, {}, "reciprocal: coefficient 0 does not exist at c = 1, u_0 = 0");
  this->ends([&] { return J(1.0) / t; }, {}, "divide: coefficient 0 does not exist at u_0 = 1, v_0 = 0");
  this->ends([&] { return t / (t * t); }, {}, "divide: coefficient 0 does not exist at u_0 = 0, v_0 = 0");
  this->ends([&] { return t / 0.0; }, {},
             "divide by constant: coefficient 0 does not exist at u_0 = 0, c = 0");
  this->ends([&] { return t / J(0.0); }, {}, "divide: coefficient 0 does not exist at u_0 = 0, v_0 = 0");
  this->ends([&] { return pow(t, -2); }, {}, "reciprocal: coefficient 0 does not exist at c = 1, u_0 = 0");
  this->ends([&] { return pow(t, -2.0); }, {}, "reciprocal: coefficient 0 does not exist at c = 1, u_0 = 0");
}

TYPED_TEST(SingularTable, QuotientsWithARemovableSingularity) {
  const auto& t = this->t;
  this->reduced(t / t, {1, 0, 0, 0});
  this->reduced(sin(t) / t, {1, 0, -1.0 / 6.0, 0});
  this->reduced((1.0 - cos(t)) / (t * t), {0.5, 0, -1.0 / 24.0});
  this->reduced(t / (t + t * t), {1, -1, 1, -1});
  this->reduced(0.0 / t, {0, 0, 0, 0});
}

/// The imaginary part of coefficient k of log(z + s t), s = 1 or i.
double imaginary_log(std::complex<double> z, std::complex<double> s, int k) {
  if (k == 0) return std::arg(z);
  return -(std::pow(-s / z, k) / static_cast<double>(k)).imag();
}
Coefficients imaginary_log(std::complex<double> z, std::complex<double> s) {
  Coefficients c;
  for (int k = 0; k <= N; ++k) c.push_back(imaginary_log(z, s, k));
  return c;
}

TYPED_TEST(SingularTable,
           AnglesOfAVariableAndAConstant) {  // atan2(y, x) is the imaginary part of log(x + i y)
  const std::complex<double> i(0, 1);
  const auto u = this->at(1.0), x = this->at(0.5);
  this->complete(atan2(sin(u), cos(u)), {1, 1, 0, 0, 0});
  this->complete(atan2(x, 2.0), imaginary_log(2.0 + 0.5 * i, i));
  this->complete(atan2(2.0, x), imaginary_log(0.5 + 2.0 * i, 1.0));
  this->complete(atan2(x, TypeParam(2.0)), imaginary_log(2.0 + 0.5 * i, i));
  this->complete(atan2(TypeParam(2.0), x), imaginary_log(0.5 + 2.0 * i, 1.0));
  EXPECT_NEAR(atan2(x, 2.0)[2], -0.0553633, 5e-8);  // as published
  EXPECT_NEAR(atan2(x, 2.0)[3], -0.0282244, 5e-8);
}

TYPED_TEST(SingularTable,
           AnglesAndLengthsAtTheOrigin) {  // through it the angle jumps by pi, the length is that for t >= 0
  const auto& t = this->t;
  using J = TypeParam;
  const double quarter = std::numbers::pi / 2;
  const std::string nowhere = "atan2: coefficient 0 does not exist at u_0 = 0, v_0 = 0";
  this->ends([&] { return atan2(t, t); }, {}, nowhere);
  this->ends([&] { return atan2(t * t, t); }, {}, nowhere);
  this->ends([&] { return atan2(t, 0.0); }, {}, nowhere);
  this->ends([&] { return atan2(0.0, t); }, {}, nowhere);
  this->ends([&] { return atan2(0.0 * t, 0.0 * t); }, {}, nowhere);
  this->reduced(atan2(t * t, t * t), {quarter / 2, 0, 0});  // to it and back
  this->reduced(atan2(t * t * t, t * t), {0, 1, 0});        // atan(t)
  this->complete(hypot(3.0 * t * t, 4.0 * t * t), {0, 0, 5, 0, 0});
  this->complete(hypot(0.0 * t, J(0.0)), {0, 0, 0, 0, 0});
  this->complete(hypot(-3.0 * t, 4.0 * t), {0, 5, 0, 0, 0});
  this->complete(hypot(-t, 0.0), {0, 1, 0, 0, 0});
  this->complete(hypot(t * t * t, 0.0), {0, 0, 0, 1, 0});
}

TYPED_TEST(SingularTable, InverseHyperbolicFunctionsOfTwoX) {  // with the factor 2 of the chain rule
  const auto x = this->at(0.1);
  Coefficients area_tangent{std::atanh(0.2)};  // (log(1 + 2x) - log(1 - 2x)) / 2
  for (int k = 1; k <= N; ++k)
    area_tangent.push_back((std::pow(2 / 0.8, k) - std::pow(-2 / 1.2, k)) / (2 * k));
  this->complete(atanh(2.0 * x), area_tangent);
  const double w = 1.04;  // 1 + u^2 at u = 0.2; the derivatives of asinh, by hand
  this->complete(asinh(2.0 * x), {std::asinh(0.2), 2 * std::pow(w, -0.5), -4 * 0.2 * std::pow(w, -1.5) / 2,
                                  8 * (2 * 0.04 - 1) * std::pow(w, -2.5) / 6,
                                  16 * (9 * 0.2 - 6 * 0.008) * std::pow(w, -3.5) / 24});
}

TYPED_TEST(SingularTable, InverseFunctionsAtTheEndsOfTheirRange) {
  const auto& t = this->t;
  const double quarter = std::numbers::pi / 2;
  this->ends([&] { return asin(1.0 - t); }, {quarter}, "asin: coefficient 1 does not exist at u_0 = 1");
  this->ends([&] { return asin(t - 1.0); }, {-quarter}, "asin: coefficient 1 does not exist at u_0 = -1");
  this->ends([&] { return asin(t + 2.0); }, {}, "asin: coefficient 0 does not exist at u_0 = 2");
  this->ends([&] { return acos(1.0 - t); }, {0}, "acos: coefficient 1 does not exist at u_0 = 1");
  this->ends([&] { return acosh(1.0 + t); }, {0}, "acosh: coefficient 1 does not exist at u_0 = 1");
  this->ends([&] { return acosh(0.5 + t); }, {}, "acosh: coefficient 0 does not exist at u_0 = 0.5");
  this->ends([&] { return atanh(2.0 + t); }, {}, "atanh: coefficient 0 does not exist at u_0 = 2");
  this->ends([&] { return atanh(1.0 - t); }, {}, "atanh: coefficient 0 does not exist at u_0 = 1");
}

TYPED_TEST(SingularTable, KinksOfTheAbsoluteValue) {
  const auto& t = this->t;
  const TypeParam zero = 0.0 * t;
  this->complete(abs(-t), {0, 1, 0, 0, 0});  // for t >= 0
  this->complete(abs(-t * t * t), {0, 0, 0, 1, 0});
  this->complete(abs(t * t), {0, 0, 1, 0, 0});
  this->complete(abs(t * t * t - t * t), {0, 0, 1, -1, 0});
  this->complete(abs(t - 1.0), {1, -1, 0, 0, 0});
  this->complete(abs(zero), {0, 0, 0, 0, 0});
  this->complete(max(t, zero), {0, 1, 0, 0, 0});
  this->complete(min(t, 0.0), {0, 0, 0, 0, 0});
  this->complete(max(1.0 + t, 1.0 + t + t * t), {1, 1, 1, 0, 0});
  this->complete(min(1.0 + t, 2.0), {1, 1, 0, 0, 0});
}

TYPED_TEST(SingularTable, WhatIsComputedFromAMissingCoefficientIsMissing) {
  if constexpr (!TestFixture::is_checked) {
    const auto& t = this->t;
    this->ends([&] { return exp(sqrt(t)); }, {1}, "");
    this->ends([&] { return sqrt(t) * sqrt(t); }, {0}, "");
    this->ends([&] { return hypot(sqrt(t), 1.0); }, {1}, "");
    this->ends([&] { return 1.0 + t * log(t); }, {}, "");
  } else {  // the caller's own NaN is not a singular point
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(known_degree(asin(TypeParam(nan))), -1);
    EXPECT_EQ(known_degree(asin(this->t / this->t * 0.5)), 3);
  }
}

}  // namespace
}  // namespace jetlag::testing::singular_table_test
