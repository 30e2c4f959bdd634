// SPDX-License-Identifier: MIT
// First-order systems whose solutions are known.
#include "jetlag/motion/first_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/factorials.hpp>
#include <stdexcept>
#include <vector>

#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::first_order_test {
namespace {

using boost::math::factorial;
using Number = RunningError<double>;

/// Component 0 of the solution through y at time t, coefficients 0 .. 20.
template <class T = Number, class F>
FirstOrderExpansion<T> solution(const F& f, const T& t, const std::vector<T>& y, int order = 20) {
  FirstOrderExpansion<T> series(f, static_cast<int>(y.size()));
  series.start(t, y);
  series.grow_to(order);
  return series;
}

TEST(FirstOrder, ExponentialGrowthHasInverseFactorials) {
  const auto x = solution([](const auto&, const auto& y) { return std::array{y[0]}; }, Number(0.0), {1.0});
  EXPECT_THAT(x[0], HasCoefficients([](int k) { return 1 / factorial<Digits50>(k); }));
}

TEST(FirstOrder,
     GeometricGrowthHasPowersOfItsStart) {  // x' = x^2: x = x_0/(1 - x_0 t); 3/2 and its powers are exact
  const auto square = [](const auto&, const auto& y) { return std::array{y[0] * y[0]}; };
  const auto ones = solution<double>(square, 0.0, {1.0}, 60);
  for (int k = 0; k <= 60; ++k) EXPECT_EQ(ones[0][k], 1.0);
  const auto x = solution(square, Number(0.0), {1.5});
  EXPECT_THAT(x[0], HasCoefficients([](int k) { return pow(Digits50(1.5), k + 1); }));
}

TEST(FirstOrder, IntegralOfCosineIsSine) {  // about t = 0.7:  sin^(k)(0.7) / k!
  const auto x = solution([](const auto& t, const auto&) { return std::array{cos(t)}; }, Number(0.7),
                          {sin(Number(0.7))});
  EXPECT_THAT(x[0], HasCoefficients([](int k) {
                const Digits50 t = 0.7, derivatives[] = {sin(t), cos(t), -sin(t), -cos(t)};
                return Digits50(derivatives[k % 4] / factorial<Digits50>(k));
              }));
}

TEST(FirstOrder, ChainOfIntegralsHasPowersOverFactorials) {  // y_0' = 1, y_n' = y_{n-1}: y_n = t^{n+1}/(n+1)!
  const auto chain = [](const auto&, const auto& y) {
    auto derivative = y;
    derivative[0] = 1.0;
    for (std::size_t n = 1; n < y.size(); ++n) derivative[n] = y[n - 1];
    return derivative;
  };
  const auto y = solution<double>(chain, 0.0, std::vector(6, 0.0), 10);
  for (int n = 0; n < 6; ++n)
    EXPECT_THAT(y[n],
                HasCoefficients([&](int k) { return k == n + 1 ? 1 / factorial<double>(k) : 0.0; }, ulps(2)));
}

TEST(FirstOrder, LogisticGrowthIsATangent) {  // y' = 1 - y^2, y(0) = 0: tanh, with the tangent numbers
  const auto y =
      solution([](const auto&, const auto& u) { return std::array{1.0 - u[0] * u[0]}; }, Number(0.0), {0.0});
  EXPECT_THAT(y[0][3], IsCloseTo(-1 / Digits50(3)));
  EXPECT_THAT(y[0][7], IsCloseTo(-17 / Digits50(315)));
  EXPECT_THAT(y[0][13], IsCloseTo(21844 / Digits50(6081075)));
}

TEST(FirstOrder, CoupledSystemsAreSolvedTogether) {  // (x, y)' = (-2y, 2x): a circle
  const auto z = solution([](const auto&, const auto& u) { return std::array{-2.0 * u[1], 2.0 * u[0]}; },
                          Number(0.0), {1.0, 0.0});
  const auto power = [](int k) {
    return pow(Digits50(2), k) / factorial<Digits50>(k) * (k / 2 % 2 ? -1 : 1);
  };
  EXPECT_THAT(z[0], HasCoefficients([&](int k) { return k % 2 ? Digits50(0) : power(k); }));
  EXPECT_THAT(z[1], HasCoefficients([&](int k) { return k % 2 ? power(k) : Digits50(0); }));
}

TEST(FirstOrder, PendulumHasItsReferenceJet) {  // x_0 = 1.3 at rest; 20 digits from a 60-digit recursion
  const auto x = solution<Digits50>([](const auto&, const auto& u) { return std::array{u[1], -sin(u[0])}; },
                                    Digits50(0), {Digits50("1.3"), Digits50(0)});
  const auto expect = [&](int k, const char* reference) {
    EXPECT_THAT(x[0][k], IsCloseTo(Digits50(reference), within(1e-19)))
        << k;  // 20 digits: 5e-20 to 5e-21 at most
  };
  expect(2, "-0.48177909270859648235");
  expect(4, "0.010739611912947171568");
  expect(10, "-3.7863518209999910781e-5");
  expect(20, "1.2833999799469046413e-9");
}

TEST(FirstOrder, ResumedIsTheFreshOne) {
  const auto f = [](const auto& t, const auto& y) { return std::array{exp(-y[0]) + t, sin(y[0] * y[1])}; };
  const auto at_once = solution<double>(f, 0.5, {1.0, 2.0}, 30);
  auto resumed = solution<double>(f, 0.5, {1.0, 2.0}, 7);
  resumed.grow();
  EXPECT_EQ(resumed.order(), 8);
  resumed.grow_to(30);  // beyond the degree that was expected
  for (int i = 0; i < 2; ++i) EXPECT_EQ(resumed[i], at_once[i]);
}

TEST(FirstOrder, StartedAnewForgetsWhatItKnew) {
  const auto f = [](const auto& t, const auto& y) { return std::array{exp(-y[0]) + t, sin(y[0] * y[1])}; };
  auto used = solution<double>(f, 0.0, {3.0, 4.0}, 25);
  used.start(0.5, {1.0, 2.0});
  EXPECT_EQ(used.order(), 0);
  used.grow_to(20);
  const auto fresh = solution<double>(f, 0.5, {1.0, 2.0}, 20);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(used[i], fresh[i]);
}

constexpr auto logistic = [](const auto&, const auto& y, const auto& p) {
  return std::array{p[0] * y[0] * (1.0 - y[0] / p[1])};
};

TEST(FirstOrder, ReadsItsParameters) {  // y' = r y (1 - y/c) from y = c/2: c/2 (1 + tanh(r t / 2))
  FirstOrderExpansion<Number> series(logistic, 1, {3.0, 5.0});
  series.start(0.0, {2.5});
  series.grow_to(7);
  const Digits50 half_rate = Digits50(3) / 2, half_capacity = Digits50(5) / 2;
  EXPECT_THAT(series[0][1], IsCloseTo(Digits50(half_capacity * half_rate)));
  EXPECT_THAT(series[0][3], IsCloseTo(Digits50(-half_capacity * pow(half_rate, 3) / 3)));
  EXPECT_THAT(series[0][7], IsCloseTo(Digits50(-half_capacity * pow(half_rate, 7) * 17 / 315)));
}

TEST(FirstOrder, WithOtherParametersIsTheFreshOne) {
  FirstOrderExpansion<> changed(logistic, 1, {3.0, 5.0}), fresh(logistic, 1, {2.0, 7.0});
  changed.start(0.0, {1.0});
  changed.grow_to(30);
  changed.set_parameters({2.0, 7.0});
  EXPECT_EQ(changed.order(), -1);  // what was known is gone
  for (auto* series : {&changed, &fresh}) {
    series->start(0.0, {1.0});
    series->grow_to(30);
  }
  EXPECT_EQ(changed[0], fresh[0]);
}

TEST(FirstOrder,
     HasParametersOfItsOwnPrecision) {  // a third, which no double is: y' = p y has y_1 = p to 50 digits
  FirstOrderExpansion<Digits50> series(
      [](const auto&, const auto& y, const auto& p) { return std::array{p[0] * y[0]}; }, 1,
      {Digits50(1) / 3});
  series.start(0, {1});
  series.grow();
  EXPECT_EQ(series[0][1], Digits50(1) / 3);
}

TEST(FirstOrder, RefusesParametersThatDoNotFit) {
  EXPECT_THROW(FirstOrderExpansion<>(logistic, 1), std::invalid_argument);
  EXPECT_THROW(FirstOrderExpansion<>(logistic, 1, {3.0}), std::invalid_argument);
  const auto without = [](const auto&, const auto& y) { return std::array{y[0]}; };
  EXPECT_THROW(FirstOrderExpansion<>(without, 1, {3.0}), std::invalid_argument);
  FirstOrderExpansion<> series(logistic, 1, {3.0, 5.0});
  EXPECT_THROW(series.set_parameters({3.0}), std::invalid_argument);
  EXPECT_NO_THROW(FirstOrderExpansion<>(logistic, 1, {3.0, 5.0, 9.0}));  // f need not read them all
}

TEST(FirstOrder, RefusesAWrongNumberOfComponents) {
  const auto f = [](const auto&, const auto& y) { return std::array{y[0]}; };
  EXPECT_THROW(FirstOrderExpansion<>(f, 2), std::invalid_argument);
  FirstOrderExpansion<> series(f, 1);
  EXPECT_THROW(series.start(0.0, {1.0, 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::first_order_test
