// SPDX-License-Identifier: MIT
// Jets against Boost.Math's automatic differentiation: functions of x, of 2x (which shows a lost factor of the chain
// rule) and of x^2 + x/4 (which shows a lost product of higher derivatives).
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>

#include "jetlag/series/elementary.hpp"
#include "support/autodiff.hpp"

namespace jetlag::testing {
namespace {

/// f of a jet is g of Boost, with three inner functions, at points from which all three stay within the range of f.
void expect_same(const OfJet& f, const OfBoost& g, std::initializer_list<double> points) {
  for (const double x : points) {
    expect_same_derivatives(f, g, x);
    expect_same_derivatives([&](const auto& u) { return f(2.0 * u); },
                            [&](const auto& u) { return g(2.0 * u); }, x);
    expect_same_derivatives([&](const auto& u) { return f(u * u + 0.25 * u); },
                            [&](const auto& u) { return g(u * u + 0.25 * u); }, x);
  }
}
template <class F>
void expect_same(const F& f, std::initializer_list<double> points) {
  expect_same(f, f, points);
}

TEST(AgreesWithBoostAutodiff, Cbrt) {
  const auto third = Digits50(1) / 3;
  expect_same([](auto x) { return cbrt(x); }, [&](auto x) { return pow(x, third); }, {0.375, 1.0, 2.75});
}
TEST(AgreesWithBoostAutodiff, Expm1) {
  expect_same([](auto x) { return expm1(x); }, [](auto x) { return exp(x) - 1; },
              {-2.75, -0.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Log1p) {
  expect_same([](auto x) { return log1p(x); }, [](auto x) { return log(x + 1); }, {-0.125, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Log2) {
  const Digits50 log_2 = boost::math::constants::ln_two<Digits50>();
  expect_same([](auto x) { return log2(x); }, [&](auto x) { return log(x) / log_2; }, {0.375, 1.0, 2.75});
}
TEST(AgreesWithBoostAutodiff, Log10) {
  const Digits50 log_10 = boost::math::constants::ln_ten<Digits50>();
  expect_same([](auto x) { return log10(x); }, [&](auto x) { return log(x) / log_10; }, {0.375, 1.0, 2.75});
}
TEST(AgreesWithBoostAutodiff, Tan) {
  expect_same([](auto x) { return tan(x); }, [](auto x) { return sin(x) / cos(x); },
              {-0.625, 0.375, 1.25, 2.75});
}
TEST(AgreesWithBoostAutodiff, Asin) {
  expect_same([](auto x) { return asin(x); }, {-0.375, 0.125, 0.4375});
}
TEST(AgreesWithBoostAutodiff, Acos) {
  expect_same([](auto x) { return acos(x); }, {-0.375, 0.125, 0.4375});
}
TEST(AgreesWithBoostAutodiff, Atan) {
  expect_same([](auto x) { return atan(x); }, {-2.75, -0.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Sinh) {
  expect_same([](auto x) { return sinh(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Cosh) {
  expect_same([](auto x) { return cosh(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Tanh) {
  expect_same([](auto x) { return tanh(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Asinh) {
  expect_same([](auto x) { return asinh(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Acosh) {
  expect_same([](auto x) { return acosh(x); }, {1.25, 2.75});
}
TEST(AgreesWithBoostAutodiff, Atanh) {
  expect_same([](auto x) { return atanh(x); }, {-0.375, 0.125, 0.4375});
}
TEST(AgreesWithBoostAutodiff, Erf) {
  expect_same([](auto x) { return erf(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Erfc) {
  expect_same([](auto x) { return erfc(x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Hypot) {
  expect_same([](auto x) { return hypot(x, 3.0); }, [](auto x) { return sqrt(x * x + 9); },
              {-1.375, 0.375, 2.75});
  expect_same([](auto x) { return hypot(0.5, x); }, [](auto x) { return sqrt(0.25 + x * x); },
              {-1.375, 0.375});
  expect_same([](auto x) { return hypot(1.0 + x, x * x); },
              [](auto x) { return sqrt((1 + x) * (1 + x) + x * x * x * x); }, {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, Atan2) {  // at points in all quadrants
  expect_same([](auto x) { return atan2(x, 2.0); }, [](auto x) { return atan(x / 2); }, {-1.375, 0.5, 2.75});
  const auto acot = [](auto x) { return boost::math::constants::half_pi<Digits50>() - atan(x / 2); };
  expect_same([](auto x) { return atan2(2.0, x); }, acot, {-1.375, 0.5, 2.75});
  expect_same([](auto x) { return atan2(x, -2.0); },
              [](auto x) { return boost::math::constants::pi<Digits50>() - atan(x / 2); }, {0.5, 2.75});
  expect_same([](auto x) { return atan2(-2.0, x); },
              [](auto x) { return -boost::math::constants::half_pi<Digits50>() + atan(x / 2); },
              {-1.375, 0.5});
  for (const double x : {0.5, 2.75, -0.5, -2.75}) {
    expect_same_derivatives([](auto u) { return atan2(u * u * u, 1.0 + u); },
                            [](auto u) { return atan2(u * u * u, 1 + u); }, x);
  }
}
TEST(AgreesWithBoostAutodiff, PowerOfANumber) {
  expect_same([](auto x) { return pow(2.5, x); }, [](auto x) { return exp(x * log(Digits50(2.5))); },
              {-1.375, 0.375, 2.75});
}
TEST(AgreesWithBoostAutodiff, PowerOfTwoSeries) {
  expect_same([](auto x) { return pow(1.0 + x, sin(x)); }, [](auto x) { return exp(sin(x) * log(1 + x)); },
              {0.375, 1.0, 2.75});
}

}  // namespace
}  // namespace jetlag::testing
