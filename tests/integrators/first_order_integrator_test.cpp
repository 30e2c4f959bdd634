// SPDX-License-Identifier: MIT
// y' = f(t, y) run by schedules: events, stop times, frames and dense output, against closed forms.
#include "jetlag/integrators/first_order_integrator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"

namespace jetlag::testing::first_order_integrator_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// y = (cos t, -sin t) from (1, 0).
const auto circle = [](const auto&, const auto& y) { return std::array{y[1], -y[0]}; };
const auto one = [](const auto& f) { return std::array{f}; };

Event level(double height, Direction direction = Direction::any) {
  return {.name = "level",
          .g = [height](const auto&, const auto& y, const auto&) { return y(0, 0) - height; },
          .direction = direction};
}

TEST(FirstOrderRuns, MeetTheirEvents) {  // cos t = 1/2 at pi/3, 5 pi/3, 7 pi/3 ..
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {level(0.5), level(0.5, Direction::rising)};
  options.hits = &hits;
  State<> state = first_order_state(0, {1, 0});
  Lockstep schedule(first_order(circle, 2));
  EXPECT_EQ(schedule.run(state, 8, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 4u);
  const double times[] = {pi / 3, 5 * pi / 3, 5 * pi / 3, 7 * pi / 3};
  for (int i = 0; i < 4; ++i) {
    // some steps of an error of some eps, at a slope of .87, and half an ulp of the time
    EXPECT_NEAR(hits[i].time, times[i], 16 * eps * times[i]);
    EXPECT_NEAR(hits[i].state.position(1, 0), -std::sin(times[i]), 16 * eps);
  }
  EXPECT_NEAR(state.position(0, 0), std::cos(8), 32 * eps);
}

TEST(FirstOrderRuns, StopAtATerminalEventWithoutAnEnd) {  // y' = -y falls to 1/2 after ln 2
  RunOptions options;
  options.events = {level(0.5, Direction::falling)};
  options.events[0].terminal = true;
  State<> state = first_order_state(0, {1});
  Lockstep schedule(first_order([](const auto&, const auto& y) { return one(-y[0]); }, 1));
  EXPECT_EQ(schedule.run(state, infinity, options).outcome, Outcome::event);
  EXPECT_NEAR(state.time, std::log(2), 8 * eps);
}

TEST(FirstOrderRuns, GoOnFromWhatAnEventChanges) {  // y' = 1, set back by 1 at 1: a saw
  RunOptions options;
  options.events = {level(1.0, Direction::rising)};
  options.events[0].change = [](State<>& state) { state.position(0, 0) -= 1; };
  State<> state = first_order_state(0, {0});
  Lockstep schedule(first_order([](const auto&, const auto& y) { return one(0.0 * y[0] + 1.0); }, 1));
  EXPECT_EQ(schedule.run(state, 3.25, options).outcome, Outcome::success);
  EXPECT_NEAR(state.position(0, 0), 0.25, 16 * eps);
}

TEST(FirstOrderRuns, EventsSeeTheSlope) {  // y' = 0 at pi, 2 pi
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {{.name = "turn", .g = [](const auto&, const auto&, const auto& v) { return v(0, 0); }}};
  options.hits = &hits;
  State<> state = first_order_state(0.1, {std::cos(0.1), -std::sin(0.1)});
  Lockstep schedule(first_order(circle, 2));
  EXPECT_EQ(schedule.run(state, 7, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].time, pi, 64 * eps);
  EXPECT_NEAR(hits[1].time, 2 * pi, 64 * eps);
}

TEST(FirstOrderRuns, LeaveTheirWholeSolution) {
  Trajectory solution;
  std::vector<double> frames;
  RunOptions options;
  options.observer.frame_times = {1.5, 4.0};
  options.observer.at_frame = [&](const State<>& at) { frames.push_back(at.position(0, 0)); };
  State<> state = first_order_state(0, {1, 0});
  Lockstep schedule(first_order(circle, 2));
  EXPECT_EQ(record(schedule, state, 10, solution, options).outcome, Outcome::success);
  for (double t = 0; t <= 10; t += 0.37) {
    EXPECT_NEAR(solution.at(t).position(0, 0), std::cos(t), 64 * eps) << t;
    EXPECT_NEAR(solution.at(t).velocity(0, 0), -std::sin(t), 256 * eps) << t;  // of degree 19
  }
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_NEAR(frames[0], std::cos(1.5), 32 * eps);
  EXPECT_NEAR(frames[1], std::cos(4.0), 32 * eps);
}

TEST(FirstOrderRuns, HaveTheBitsOfTheMethod) {
  FirstOrderTaylor<> method(circle, 2);
  FirstOrderState<> y{0.0, {1, 0}};
  State<> state = first_order_state(0, {1, 0});
  ASSERT_EQ(method.run(y, 50).outcome, Outcome::success);
  Lockstep schedule(first_order(circle, 2));
  ASSERT_EQ(schedule.run(state, 50, RunOptions{}).outcome, Outcome::success);
  EXPECT_EQ(state.position(0, 0), y.y[0]);
  EXPECT_EQ(state.position(1, 0), y.y[1]);
  EXPECT_EQ(schedule.work().steps, method.work().steps);
}

TEST(FirstOrderRuns, RefuseAStateOfAnotherShape) {
  Lockstep schedule(first_order(circle, 2));
  State<> state = first_order_state(0, {1, 0, 0});
  EXPECT_THROW(schedule.run(state, 1, RunOptions{}), std::invalid_argument);
}

// ---- steps that are given --------------------------------------------------------------------------------

/// y' = atan2(sin t, cos t), a jump at pi of which the tape knows nothing: those that are off say so.
TEST(FirstOrderGivenSteps, SayWhatTheyMayHaveGotWrong) {
  const auto saw = [](const auto& t, const auto&) { return one(atan2(sin(t), cos(t))); };
  const double truth = pi * pi / 2 + (5 - pi) * (5 - pi) / 2 - pi * (5 - pi), extent = pi * pi / 2;
  int off = 0;
  for (double h : {0.5, 0.3, 0.1, 0.03, 0.01}) {
    FirstOrderTaylor<> method(saw, 1, {.degree = 8, .step = h});
    FirstOrderState<> state{0.0, {0.0}};
    ASSERT_EQ(method.run(state, 5).outcome, Outcome::success);
    if (std::abs(state.y[0] - truth) < 1e-3 * extent) continue;
    ++off;
    EXPECT_THAT(method.warning(), HasSubstr("contradict")) << h;
  }
  EXPECT_GE(off, 3);
}

TEST(FirstOrderGivenSteps, SayNothingWhereTheyAreRight) {
  FirstOrderTaylor<> smooth(circle, 2, {.degree = 12, .step = 0.1});
  FirstOrderState<> state{0.0, {1, 0}};
  ASSERT_EQ(smooth.run(state, 100).outcome, Outcome::success);
  EXPECT_THAT(smooth.warning(), IsEmpty());
  // a choice is met on time, whatever the step
  FirstOrderTaylor<> kinked([](const auto& t, const auto&) { return one(abs(t - 1.03)); }, 1,
                            {.degree = 4, .step = 0.1});
  FirstOrderState<> y{0.0, {0.0}};
  ASSERT_EQ(kinked.run(y, 2).outcome, Outcome::success);
  EXPECT_NEAR(y.y[0], (1.03 * 1.03 + 0.97 * 0.97) / 2, 16 * eps);
  EXPECT_THAT(kinked.warning(), IsEmpty());
}

}  // namespace
}  // namespace jetlag::testing::first_order_integrator_test
