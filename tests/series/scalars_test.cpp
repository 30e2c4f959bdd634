// SPDX-License-Identifier: MIT
// The numbers that jets are made of: fractions, and jets themselves (derivatives by parameters).
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing {
namespace {

// ---- fractions --------------------------------------------------------------------------------------------

using Fraction =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

template <class J>
J random_fractions(Uniform& draw) {
  J u(0);
  if constexpr (J::degree_at_compile_time == Dynamic) u.resize(12);
  for (int k = 0; k <= u.degree(); ++k)
    u[k] = Fraction(static_cast<int>(draw(-99, 99)), 1 + static_cast<int>(draw(0, 99)));
  return u;
}

template <class J>
void expect_euler_identity() {
  Uniform draw(4);
  std::array<J, 4> a, b;
  for (J& u : a) u = random_fractions<J>(draw);
  for (J& u : b) u = random_fractions<J>(draw);
  const J left = (square(a[0]) + square(a[1]) + square(a[2]) + square(a[3])) *
                 (square(b[0]) + square(b[1]) + square(b[2]) + square(b[3]));
  const J right = square(a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]) +
                  square(a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]) +
                  square(a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]) +
                  square(a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]);
  EXPECT_EQ(left, right);
  EXPECT_EQ(left / right, J(1));
}

TEST(JetOfFractions, HasEulersFourSquareIdentity) {  // the norm of a product of quaternions, exactly
  expect_euler_identity<Jet<Fraction, 12>>();
  expect_euler_identity<Jet<Fraction, Dynamic>>();
}

TEST(JetOfFractions, DividesExactly) {  // 1/(1 - t - t^2): the Fibonacci numbers
  using J = Jet<Fraction, 30>;
  const J t = J::variable(0), fibonacci = 1 / (1 - t - t * t);
  EXPECT_EQ(fibonacci[30], 1346269);
  EXPECT_EQ((2 - fibonacci) / 3 * 3, 2 - fibonacci);
}

// ---- jets of jets -----------------------------------------------------------------------------------------

/// f(x + t; p) with p = 0.7 + s: the derivative by p of every coefficient in t.
template <class F>
void expect_parameter_derivative(F f) {
  constexpr int N = 10;
  using Number = RunningError<double>;
  using Inner = Jet<Number, 1>;
  const Jet<Inner, N> with_parameter = f(Jet<Inner, N>::variable(0.4), Inner::variable(0.7));

  // central difference in 50 digits: its error is f''' h^2 / 6, here below 1e-20 of the derivative for h = 1e-15
  using Wide = Jet<Digits50, N>;
  const Digits50 h("1e-15");
  const Wide t = Wide::variable(Digits50(0.4));
  const Wide above = f(t, Digits50(0.7) + h), below = f(t, Digits50(0.7) - h);
  Jet<Number, N> derivative;
  for (int k = 0; k <= N; ++k) derivative[k] = with_parameter[k][1];
  EXPECT_THAT(derivative, HasCoefficients([&](int k) { return Digits50((above[k] - below[k]) / (2 * h)); }));
}

TEST(NestedJet, HasTheDerivativeByAParameter) {
  expect_parameter_derivative([](const auto& x, const auto& p) { return sin(p * x) / (1.0 + x * p); });
  expect_parameter_derivative([](const auto& x, const auto& p) { return exp(p - x) * sqrt(x + p); });
  expect_parameter_derivative([](const auto& x, const auto& p) { return log(p + x * x) - 2.0 * p / x; });
  expect_parameter_derivative(
      [](const auto& x, const auto& p) { return pow(1.0 + p * x, -1.5) * cos(x - p); });
}

TEST(NestedJet, TakesNumbersOfEveryLevel) {
  using One = Jet<double, 1>;
  using Two = Jet<One, 2>;
  using Three = Jet<Two, 3>;
  const One p = One::variable(2.0);
  const Two u = Two::variable(p);
  const Three v = Three::variable(u);
  EXPECT_EQ(2.0 * v, v + v);
  EXPECT_EQ(2 * v * 0.5, v);
  EXPECT_EQ((p * v)[0][0], One::from({4, 4}));
  EXPECT_EQ((v * u)[1], u);
  EXPECT_EQ((u - v + 1.0)[0], Two(1.0));
  EXPECT_EQ(p / (p / v), v);  // powers of two
  EXPECT_EQ((v / 2.0)[1], Two(0.5));
  EXPECT_EQ(v * v, square(v));
  EXPECT_EQ(pow(v, 3), v * v * v);
}

TEST(NestedJet, OfDynamicJetsIsAJet) {
  using Inner = Jet<double, Dynamic>;
  using Outer = Jet<Inner, Dynamic>;
  const auto f = [](const auto& x) { return exp(x) / (2.0 + x * x); };
  const Outer u = f(Outer::variable(Inner::variable(0.3, 4), 5));
  using J = Jet<Jet<double, 4>, 5>;
  const J v = f(J::variable(Jet<double, 4>::variable(0.3)));
  ASSERT_EQ(u.degree(), 5);
  for (int i = 0; i <= 5; ++i) EXPECT_EQ(u[i], Inner(v[i])) << i;
}

TEST(NestedJet, IsComparedByTheFirstCoefficientThatDiffers) {
  using J = Jet<Jet<double, 1>, 2>;
  const J u = J::variable(Jet<double, 1>::variable(2.0));
  EXPECT_GT(u, 1.0);
  EXPECT_LT(u, J(3.0));
  EXPECT_GT(u, 2.0);  // 2 + s + t
  EXPECT_GT(u, 2.0 + J::variable(0.0));
  EXPECT_LE(u, u);
  EXPECT_NE(u, 2.0);
  EXPECT_TRUE(isfinite(u));
  EXPECT_FALSE(isfinite(log(u - 2.0)));
}

TEST(NestedJet, LosesAllThatACommonPowerTakes) {  // an unknown coefficient is not known in any of its parts
  using J = Jet<Jet<double, 1>, 2>;
  const J t = J::variable(0.0), q = (t * Jet<double, 1>::variable(3.0)) / t;
  EXPECT_EQ(known_degree(q), 1);
  EXPECT_EQ(q[0], (Jet<double, 1>::from({3, 1})));
  EXPECT_EQ(known_degree(q[2]), -1);
  EXPECT_TRUE(std::isnan(q[2][1]));
}

}  // namespace
}  // namespace jetlag::testing
