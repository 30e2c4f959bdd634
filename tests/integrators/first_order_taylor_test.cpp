// SPDX-License-Identifier: MIT
// Taylor's method for first-order systems, against closed forms; how runs end.
#include "jetlag/integrators/first_order_taylor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::first_order_taylor_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

constexpr auto circle = [](const auto&, const auto& u) { return std::array{-u[1], u[0]}; };
constexpr auto decay = [](const auto&, const auto& y, const auto& p) { return std::array{-p[0] * y[0]}; };
constexpr auto blow_up = [](const auto&, const auto& y) {
  return std::array{y[0] * y[0]};
};  // 1 / (1 - t) from 1

/// The error after `turns` on the circle, and the steps it took.
template <class T>
std::pair<T, int> error_after(int turns) {
  FirstOrderTaylor<T> method(circle, 2);
  FirstOrderState<T> state{T(0), {T(1), T(0)}};
  // 2 pi in T is off by rounding: the truth at that time, to first order.
  const T turn = boost::math::constants::two_pi<T>();
  EXPECT_EQ(method.run(state, T(turn * turns)).outcome, Outcome::success);
  using std::abs, std::max;
  return {max(abs(T(state.y[0] - 1)), abs(state.y[1])), static_cast<int>(method.work().steps)};
}

TEST(FirstOrderTaylor, SaysHowManyStepsEachRunTook) {
  FirstOrderTaylor<> method([](const auto&, const auto& y) { return std::array{-y[0]}; }, 1, {.step = 0.25});
  FirstOrderState<> state{0.0, {1.0}};
  EXPECT_EQ(method.run(state, 1.0).steps, 4u);
  EXPECT_EQ(method.run(state, 0.5).steps, 2u);
}

TEST(FirstOrderTaylor, GoesRoundTheCircleToTheRoundingOfEveryType) {
  // The speed is 1, so the time 2 pi n, rounded, is an error of eps 2 pi n at most; the increments of a step are
  // below 1: eps / 2 a step for their rounding, and as much for the terms left out.
  const auto bound = [](double precision, int turns, int steps) {
    return precision * (2 * std::numbers::pi * turns + steps);
  };
  const auto plain = error_after<double>(20);
  EXPECT_LT(plain.first, bound(eps, 20, plain.second));
  const auto extended = error_after<long double>(20);
  EXPECT_LT(extended.first, bound(0x1p-63, 20, extended.second));
  const auto many = error_after<Digits50>(2);
  EXPECT_LT(many.first, bound(1e-50, 2, many.second));
}

TEST(FirstOrderTaylor, TakesTheDegreeFromThePrecisionOfTheType) {  // ceil(1 - ln(eps) / 2)
  EXPECT_EQ(FirstOrderTaylor<float>(circle, 2).options().degree, 9);
  EXPECT_EQ(FirstOrderTaylor<>(circle, 2).options().degree, 20);
  EXPECT_EQ(FirstOrderTaylor<long double>(circle, 2).options().degree, 23);
}

TEST(FirstOrderTaylor, LosesLessToRoundingWithItsStateCompensated) {
  // Steps of 1/32 to t = 1000. Plain, each step rounds u, by some eps / 4, and the radius walks at random. Compensated,
  // what is left is the rounding of increments of 1/32: some sqrt(32000) eps / 4 / 32.
  const auto radius_error = [](bool compensated) {
    FirstOrderTaylor<> method(circle, 2, {.max_step = 0x1p-5, .compensated = compensated});
    FirstOrderState<> state{0.0, {1.0, 0.0}};
    method.run(state, 1000.0);
    const long double u = state.y[0], v = state.y[1];
    return static_cast<double>(std::abs(std::hypot(u, v) - 1));
  };
  EXPECT_LT(radius_error(true), 5 * std::sqrt(32000.0) * eps / 4 / 32);
  EXPECT_LT(radius_error(true), radius_error(false) / 8);
}

TEST(FirstOrderTaylor, HasTheOrderOfItsDegree) {
  for (int degree : {2, 3, 5, 8}) {
    // Over [0, 1] in n steps the phase or the radius of the circle is off by h^N / (N+1)!, to first order in h.
    const auto error = [&](int steps) {
      FirstOrderTaylor<long double> method(circle, 2, {.degree = degree, .max_step = 1.0 / steps});
      FirstOrderState<long double> state{0, {1, 0}};
      for (int i = 0; i < steps; ++i) {  // steps of one length, whatever the control
        Report report;
        EXPECT_EQ(method.step(state, 1.0L / steps, report), 1.0L / steps) << degree;
        state.time = (i + 1.0L) / steps;
      }
      return std::hypot(state.y[0] - std::cos(1.0L), state.y[1] - std::sin(1.0L));
    };
    const int n = degree < 8 ? 64 : 16;  // the errors of degree 8 are 16^-8 / 9!, far above 2^-64
    EXPECT_NEAR(static_cast<double>(std::log2(error(n) / error(2 * n))), degree, 0.05);
  }
}

TEST(FirstOrderTaylor, EndsAtTheTimeAskedFor) {
  FirstOrderTaylor<> method(decay, 1, {.parameters = {1.0}});
  FirstOrderState<> state{0.0, {1.0}};
  for (double until : {0.1, 0.1 + 0x1p-50, 1.0 / 3.0, 7.7, 7.7}) {
    EXPECT_EQ(method.run(state, until).outcome, Outcome::success);
    EXPECT_EQ(state.time, until);
    EXPECT_NEAR(state.y[0], std::exp(-until), 8 * eps * std::exp(-until)) << until;
  }
}

TEST(FirstOrderTaylor, RunsBackwards) {  // e^{-t} from 1 back to -5, and to 0 again
  FirstOrderTaylor<> method(decay, 1, {.parameters = {1.0}});
  FirstOrderState<> state{0.0, {1.0}};
  EXPECT_EQ(method.run(state, -5.0).outcome, Outcome::success);
  EXPECT_EQ(state.time, -5.0);
  EXPECT_NEAR(state.y[0], std::exp(5.0), 8 * eps * std::exp(5.0));
  EXPECT_EQ(method.run(state, 0.0).outcome, Outcome::success);
  EXPECT_NEAR(state.y[0], 1.0, 16 * eps);
}

TEST(FirstOrderTaylor, KnowsTheTime) {  // y' = 2 t y: exp(t^2)
  FirstOrderTaylor<> method([](const auto& t, const auto& y) { return std::array{2.0 * t * y[0]}; }, 1);
  FirstOrderState<> state{-1.0, {std::numbers::e}};
  EXPECT_EQ(method.run(state, 2.0).outcome, Outcome::success);
  // From t = -1 to 0 relative errors stay, they are eps / 2 a step and 2 t^2 eps for the time.
  EXPECT_NEAR(state.y[0], std::exp(4.0), 16 * eps * std::exp(4.0));
}

TEST(FirstOrderTaylor, TakesOtherParametersBetweenRuns) {
  FirstOrderTaylor<> method(decay, 1, {.parameters = {1.0}});
  FirstOrderState<> state{0.0, {1.0}};
  method.run(state, 1.0);
  method.set_parameters({3.0});
  method.run(state, 2.0);
  EXPECT_NEAR(state.y[0], std::exp(-4.0), 8 * eps * std::exp(-4.0));
  EXPECT_EQ(method.options().parameters, std::vector{3.0});
}

TEST(FirstOrderTaylor, IsDenseWithinAStep) {
  FirstOrderTaylor<> method(circle, 2);
  FirstOrderState<> state{0.0, {1.0, 0.0}};
  int seen = 0;
  const auto look = [&](const FirstOrderStepView<>& view) {
    for (double part : {0.0, 0.3, 0.77, 1.0}) {
      const double t = view.begin + part * (view.state.time - view.begin);
      const std::vector<double> y = view.integrator.at(t);
      // As exact as the state: some eps for its steps, eps t for the time.
      EXPECT_NEAR(y[0], std::cos(t), (8 + t) * eps) << t;
      EXPECT_NEAR(y[1], std::sin(t), (8 + t) * eps) << t;
    }
    // At the end the sums are those of the step, but for the last bit of the time.
    const std::vector<double> end = view.integrator.at(view.state.time);
    EXPECT_NEAR(end[0], view.state.y[0], (1 + view.state.time) * eps);
    ++seen;
    return true;
  };
  EXPECT_EQ(method.run(state, 10.0, {.after_step = look}).outcome, Outcome::success);
  EXPECT_EQ(seen, static_cast<int>(method.work().steps));
}

TEST(FirstOrderTaylor, TakesTheSameStepsInEveryUnitOfTime) {  // y'' = -w^2 y: coefficient 20 is some w^20
  const auto fast = [](const auto&, const auto& u, const auto& p) {
    return std::array{-p[0] * u[1], p[0] * u[0]};
  };
  for (int exponent : {-340, -60, 0, 60, 340}) {
    const double w = std::ldexp(1.0, exponent);
    FirstOrderTaylor<> method(fast, 2, {.parameters = {w}});
    FirstOrderState<> state{0.0, {1.0, 0.0}};
    EXPECT_EQ(method.run(state, 10 / w).outcome, Outcome::success) << exponent;
    FirstOrderTaylor<> plain(circle, 2);
    FirstOrderState<> expected{0.0, {1.0, 0.0}};
    plain.run(expected, 10.0);
    for (int i : {0, 1})  // the phase: eps for each step's length and that of their sum, 10
      EXPECT_NEAR(state.y[i], expected.y[i], 20 * eps) << exponent;
    EXPECT_EQ(method.work().steps, plain.work().steps) << exponent;
  }
}

TEST(FirstOrderTaylor, CountsItsWork) {
  FirstOrderTaylor<> method(circle, 2, {.degree = 12});
  FirstOrderState<> state{0.0, {1.0, 0.0}};
  EXPECT_EQ(method.run(state, 1e9, {.max_steps = 10}).outcome, Outcome::step_limit);
  EXPECT_EQ(method.work().steps, 10u);
  EXPECT_EQ(method.work().updates, 20u);
  EXPECT_EQ(method.work().coefficients, 240u);
  EXPECT_EQ(method.work().element_coefficients, 120u);
  EXPECT_EQ(method.work().mean_degree(), 12);
}

// ---- how it ends ------------------------------------------------------------------------------------------

TEST(FirstOrderTaylor, StopsAtASingularityOfTheSolution) {
  FirstOrderTaylor<> method(blow_up, 1);
  FirstOrderState<> state{0.0, {1.0}};
  const Report report = method.run(state, 2.0);
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  // Each step goes a fixed part of the way; the last one is half of the last place of 1.
  EXPECT_NEAR(state.time, 1.0, 16 * eps);
  EXPECT_TRUE(std::isfinite(state.y[0]));
  EXPECT_NE(report.message.find("singular"), std::string::npos);
}

TEST(FirstOrderTaylor, NamesTheCoefficientThatDoesNotExist) {  // y_1' = sqrt(y_1) from 0
  FirstOrderTaylor<> method([](const auto&, const auto& y) { return std::array{y[0], sqrt(y[1])}; }, 2);
  FirstOrderState<> state{3.0, {1.0, 0.0}};
  const Report report = method.run(state, 5.0);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_NE(report.message.find("of y[1] is not finite at t = 3"), std::string::npos) << report.message;
  EXPECT_EQ(report.particle, 1);
  EXPECT_EQ(state.time, 3.0);
  EXPECT_EQ(state.y, (std::vector{1.0, 0.0}));
}

TEST(FirstOrderTaylor, LeavesTheLastGoodStateWhereANumberOverflows) {  // e^{1000 t} ends at ln(max) / 1000
  FirstOrderTaylor<> method(decay, 1, {.parameters = {-1000.0}});
  FirstOrderState<> state{0.0, {1.0}};
  const Report report = method.run(state, 1.0);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_TRUE(std::isfinite(state.y[0]));
  EXPECT_NEAR(state.y[0], std::exp(1000 * state.time),
              1e-11 * state.y[0]);  // 710 of them, each eps of the exponent
}

TEST(FirstOrderTaylor, MayBeInterruptedAndResumed) {
  FirstOrderTaylor<> method(circle, 2);
  FirstOrderState<> state{0.0, {1.0, 0.0}};
  const auto stop = [](const FirstOrderStepView<>& view) { return view.state.time < 1.0; };
  EXPECT_EQ(method.run(state, 10.0, {.after_step = stop}).outcome, Outcome::interrupted);
  EXPECT_GE(state.time, 1.0);
  EXPECT_LT(state.time, 2.0);
  EXPECT_EQ(method.run(state, 10.0).outcome, Outcome::success);
  EXPECT_NEAR(state.y[0], std::cos(10.0), 20 * eps);
}

TEST(FirstOrderTaylor, RefusesWhatItCannotDo) {
  EXPECT_THROW(FirstOrderTaylor<>(circle, 0), std::invalid_argument);
  EXPECT_THROW(FirstOrderTaylor<>(circle, 2, {.degree = 1}), std::invalid_argument);
  EXPECT_THROW(FirstOrderTaylor<>(circle, 2, {.max_step = 0.0}), std::invalid_argument);
  FirstOrderTaylor<> method(circle, 2);
  FirstOrderState<> state{0.0, {1.0, 0.0}};
  EXPECT_THROW(method.run(state, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(method.run(state, std::numeric_limits<double>::infinity()), std::invalid_argument);
  FirstOrderState<> never{std::numeric_limits<double>::quiet_NaN(), {1.0, 0.0}};
  EXPECT_THROW(method.run(never, 1.0), std::invalid_argument);
  FirstOrderState<> short_one{0.0, {1.0}}, short_rest{0.0, {1.0, 0.0}, {0.0}};
  EXPECT_THROW(method.run(short_one, 1.0), std::invalid_argument);
  EXPECT_THROW(method.run(short_rest, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::first_order_taylor_test
