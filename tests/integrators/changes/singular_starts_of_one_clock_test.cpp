// SPDX-License-Identifier: MIT
// Taylor's method of any number type from where a force has no series: a norm or root of what is zero there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "integrators/changes/singular_laws.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::singular_starts_of_one_clock_test {
namespace {

using namespace singular_laws;

TEST(SingularStartOfOneClock,
     FallsFromRestBothWaysInTime) {  // backwards drag pushes: x = ln cos(sqrt(g c) t) / -c
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  for (const std::optional<double> step : {std::optional<double>(), std::optional<double>(0.031)}) {
    ParticleTaylor<> method(system, {.step = step});
    State<> state = at_rest(1, 2);
    Report report = method.run(state, 2);
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    EXPECT_NEAR(state.position(0, 1), -fallen(9.8, 0.1, 2), 1e-11);
    EXPECT_NEAR(state.velocity(0, 1), -falling(9.8, 0.1, 2), 1e-11);
    state = at_rest(1, 2);
    report = method.run(state, -1);
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    EXPECT_NEAR(state.position(0, 1), 10 * std::log(std::cos(std::sqrt(0.98))), 1e-11);
  }
}

TEST(SingularStartOfOneClock, KeepsTheDigitsOfItsNumbers) {
  System<long double> system(1, {1.0L});
  system.add<QuadraticDrag>({{0}}, {{1.0L}});
  system.add<UniformField>({{0}}, {{1.0L, 0.0L, 0.0L}});
  ParticleTaylor<long double> method(system);
  State<long double> state{0, Coordinates<long double>::Zero(1, 1), Coordinates<long double>::Zero(1, 1)};
  const Report report = method.run(state, 1);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  EXPECT_NEAR(static_cast<double>(state.position(0, 0) - std::log(std::cosh(1.0L))), 0, 1e-17);
}

TEST(SingularStartOfOneClock, StaysAtRestOrSaysWhyNot) {
  System<> drag(2, {1.0}), cone(1, {1.0}), together(2, {1.0, 1.0});
  drag.add<QuadraticDrag>({{0}}, {{0.1}});
  cone.add<Cone>({{0}}, {none});
  together.add<RelativeDrag>({{0, 1}}, {none});
  together.add<UniformField>({{0}, {1}}, {{0.0, -9.8, 0.0}, {0.0, -9.8, 0.0}});
  State<> state = at_rest(1, 2);
  Report report = ParticleTaylor<>(drag).run(state, 2);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  EXPECT_TRUE(state.position.isZero(0.0));
  state = at_rest(1, 1);
  EXPECT_EQ(ParticleTaylor<>(cone).run(state, 2).outcome, Outcome::non_finite);
  state = at_rest(2, 2);
  report = ParticleTaylor<>(together).run(state, 2);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_NE(report.message.find("a norm or root of what is zero?"), std::string::npos) << report.message;
}

TEST(SingularStartOfOneClock, FollowsTheHalfDisc) {
  System<> system(1, {1.0});
  system.add<HalfDisc>({{0}}, {none});
  State<> state = at_rest(1, 1);
  const Report report = ParticleTaylor<>(system).run(state, 0.5);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  EXPECT_NEAR(state.velocity(0, 0), M_PI / 16, 1e-12);
  EXPECT_NEAR(state.position(0, 0), 1.0 / 24, 1e-12);
  state = at_rest(1, 1);
  // What is left to the edge where the steps end is below its 2^-36: of a force below 2^-18, 2^-54.
  if (ParticleTaylor<>(system).run(state, 1).outcome == Outcome::success) {
    EXPECT_NEAR(state.velocity(0, 0), M_PI / 8, 1e-12);
  }
}

TEST(SingularStartOfOneClock, FollowsPushesThatGrowFromRestAtLateTimes) {
  for (const double start : {0.0, 1.0, 100.0}) {
    System<> system(1, {1.0});
    system.add<GrowingPush>({{0}}, {{start}});
    State<> state = at_rest(1, 1);
    state.time = start;
    const Report report = ParticleTaylor<>(system).run(state, start + 1);
    EXPECT_EQ(report.outcome, Outcome::success) << "from " << start << ": " << report.message;
    EXPECT_NEAR(state.position(0, 0), 1.0 / 2 + 1.0 / 6, 1e-11 + 3e-15 * start);
  }
}

TEST(SingularStartOfOneClock, DoesNotDependOnHowFarItIsToGo) {
  System<> system(1, {1.0});
  system.add<QuadraticDrag>({{0}}, {{1.0}});
  system.add<UniformField>({{0}}, {{10.0, 0.0, 0.0}});
  const auto drag = [](auto&, auto& y) { return std::array{Recorded(10.0) - y[0] * sqrt(y[0] * y[0])}; };
  // 8 eps of the terminal speed, sqrt 10, and some roundings of it
  const double allowed = 20 * 2.2e-16 * std::sqrt(10.0);
  for (const double limit : {1.0, 1e4, 1e8, 1e10}) {
    Report report;
    ParticleTaylor<> method(system);
    State<> state = at_rest(1, 1);
    const double h = method.step(state, limit, report);
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    EXPECT_NEAR(state.velocity(0, 0), falling(10, 1, h), allowed) << limit;

    FirstOrderTaylor<> of_speed(drag, 1);
    FirstOrderState<> speed{0.0, {0.0}};
    const double s = of_speed.step(speed, limit, report);
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    EXPECT_NEAR(speed.y[0], falling(10, 1, s), allowed) << limit;
  }
}

TEST(SingularStartOfOneClock, TakesNoStepLongerThanItMay) {
  System<> system(1, {1.0});
  system.add<QuadraticDrag>({{0}}, {{1.0}});  // rests, without a series
  ParticleTaylor<> method(system, {.max_step = 0.25});
  State<> state = at_rest(1, 1);
  EXPECT_EQ(method.run(state, 2).outcome, Outcome::success);
  EXPECT_EQ(method.work().steps, 8u);
}

}  // namespace
}  // namespace jetlag::testing::singular_starts_of_one_clock_test
