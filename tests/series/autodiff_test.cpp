// SPDX-License-Identifier: MIT
// Jets against Boost.Math's automatic differentiation: arithmetic and the first functions.
#include "support/autodiff.hpp"

#include <gtest/gtest.h>

#include "jetlag/series/elementary.hpp"

namespace jetlag::testing {
namespace {

/// At points where all functions below exist.
template <class F>
void expect_same_derivatives(F f) {
  for (const double x : {0.375, 1.0, 2.75}) jetlag::testing::expect_same_derivatives(f, x);
}

TEST(AgreesWithBoostAutodiff, Sum) {
  expect_same_derivatives([](auto x) { return x + 1.0 / x; });
  expect_same_derivatives([](auto x) { return 0.5 + x + 0.25; });
}
TEST(AgreesWithBoostAutodiff, Difference) {
  expect_same_derivatives([](auto x) { return 1.0 / x - x * x; });
  expect_same_derivatives([](auto x) { return 0.5 - (x - 0.25); });
  expect_same_derivatives([](auto x) { return -x; });
}
TEST(AgreesWithBoostAutodiff, Product) {
  expect_same_derivatives([](auto x) { return (x + 2.0) * (3.0 - x) * (x * x); });
  expect_same_derivatives([](auto x) { return 2.0 * x * 0.25; });
}
TEST(AgreesWithBoostAutodiff, Quotient) {
  expect_same_derivatives([](auto x) { return (x - 5.0) / (x * x + 1.0); });
  expect_same_derivatives([](auto x) { return x / 8.0 + 3.0 / (2.0 * x); });
}
TEST(AgreesWithBoostAutodiff, Sqrt) {
  expect_same_derivatives([](auto x) { return sqrt(x); });
  expect_same_derivatives([](auto x) { return sqrt(2.0 * x); });
  expect_same_derivatives([](auto x) { return sqrt(1.0 + x * x * x); });
}
TEST(AgreesWithBoostAutodiff, RealPower) {
  expect_same_derivatives([](auto x) { return pow(x, 1.5); });
  expect_same_derivatives([](auto x) { return pow(2.0 * x, -0.75); });
  expect_same_derivatives([](auto x) { return pow(1.0 + x * x, -1.5); });
}
TEST(AgreesWithBoostAutodiff, WholePower) {  // there, a product: its pow of a variable takes the logarithm
  expect_same_derivatives([]<class X>(X x) {
    if constexpr (is_jet<X>)
      return pow(2.0 * x - 3.0, 5);
    else
      return X((2.0 * x - 3.0) * (2.0 * x - 3.0) * (2.0 * x - 3.0) * (2.0 * x - 3.0) * (2.0 * x - 3.0));
  });
  expect_same_derivatives([]<class X>(X x) {
    if constexpr (is_jet<X>)
      return pow(x * x + 1.0, -3);
    else
      return X(1.0 / ((x * x + 1.0) * (x * x + 1.0) * (x * x + 1.0)));
  });
}
TEST(AgreesWithBoostAutodiff, Exp) {
  expect_same_derivatives([](auto x) { return exp(x); });
  expect_same_derivatives([](auto x) { return exp(2.0 * x); });
  expect_same_derivatives([](auto x) { return exp(-x * x); });
}
TEST(AgreesWithBoostAutodiff, Log) {
  expect_same_derivatives([](auto x) { return log(x); });
  expect_same_derivatives([](auto x) { return log(2.0 * x); });
  expect_same_derivatives([](auto x) { return log(1.0 + x * x); });
}
TEST(AgreesWithBoostAutodiff, Sin) {
  expect_same_derivatives([](auto x) { return sin(x); });
  expect_same_derivatives([](auto x) { return sin(2.0 * x); });
  expect_same_derivatives([](auto x) { return sin(1.0 / x); });
}
TEST(AgreesWithBoostAutodiff, Cos) {
  expect_same_derivatives([](auto x) { return cos(x); });
  expect_same_derivatives([](auto x) { return cos(2.0 * x); });
  expect_same_derivatives([](auto x) { return cos(sqrt(x)); });
}
TEST(AgreesWithBoostAutodiff, AllTogether) {
  expect_same_derivatives([](auto x) { return exp(sin(2.0 * x)) / sqrt(1.0 + x * x) - cos(log(x)) * x; });
}

}  // namespace
}  // namespace jetlag::testing
