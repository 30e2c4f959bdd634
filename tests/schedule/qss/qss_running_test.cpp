// SPDX-License-Identifier: MIT
// Quantized state systems: how they run, when they show themselves, how they end and what they refuse.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/floor.hpp"
#include "jetlag/schedule/qss.hpp"
#include "jetlag/schedule/record.hpp"
#include "schedule/events/events_for_tests.hpp"
#include "schedule/without_a_trace.hpp"

namespace jetlag::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Qss::Options coarse{.order = 2, .quantum = 1e-3, .velocity_quantum = 1e-3};

/// Pushed by cos t, which changes where no state does.
Problem shaken() {
  System<double> system(1, {1.0});
  system.add<Shaker>({{0}}, {{1.0}});
  return {std::move(system), {0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Zero(1, 1)}};
}

/// Flies at 1 m/s from 1 m onto a floor of stiffness 100 at 0: back at 1 m after 2 + pi / 10 s.
Problem bounce() {
  System<double> system(1, {1.0});
  system.add<Floor>({{0}}, {{100.0, 0.0, 1.0, 0.0, 0.0}});
  return {std::move(system),
          {0.0, Coordinates<double>::Ones(1, 1), Coordinates<double>::Constant(1, 1, -1.0)}};
}

TEST(Qss, EndsAndIsSeenAtAnyTimeWithoutATrace) {
  expect_ends_and_frames_leave_no_trace([](const System<double>& system) { return Qss(system, coarse); });
}

TEST(Qss, LeavesATrajectoryThatMeetsItself) {
  const Problem cube = spring_cube(5);
  Qss qss(cube.system, coarse);
  State<double> state = cube.start;
  Trajectory motion;
  ASSERT_EQ(record(qss, state, 1.0, motion).outcome, Outcome::success);
  EXPECT_EQ(motion.size(), qss.work().steps + 1);
  for (std::size_t p = 1; p < motion.size(); ++p) {  // continuous but for rounding
    const double t = motion.piece(p).begin;
    EXPECT_LT((motion.piece(p - 1).at(t).position - motion.piece(p).at(t).position).norm(), 1e-14);
    EXPECT_LT((motion.piece(p - 1).at(t).velocity - motion.piece(p).at(t).velocity).norm(), 1e-14);
  }
  EXPECT_NEAR((motion.at(1.0).position - state.position).norm(), 0, 1e-14);
}

TEST(Qss, TellsTheUpdatesOfEachParticle) {
  Problem cube = spring_cube(5);
  cube.system.fix(3);
  cube.start.velocity.row(3).setZero();
  Qss qss(cube.system, coarse);
  std::vector<double> known_until(8, 0.0);
  RunOptions options;
  options.observer.on_update = [&](const Update& update) {
    EXPECT_EQ(update.begin, known_until[update.particle]);
    EXPECT_GT(update.step, 0);
    EXPECT_TRUE(update.degree == 2 || (update.degree == 1 && update.begin < 0.2));  // no force at first
    known_until[update.particle] = update.begin + update.step;
  };
  State<double> state = cube.start;
  ASSERT_EQ(qss.run(state, 1.0, options).outcome, Outcome::success);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(known_until[i] > 0.8, i != 3) << i;
  EXPECT_EQ(state.position.row(3), cube.start.position.row(3));
}

TEST(Qss, StartsAtAnyTime) {
  // Times before 0 are in order too: the same events from -1024 as from 0, each to the last place of its time, 2^-43,
  // which moves a state by less than 1e-12.
  Problem late = spring_cube(5);
  State<double> from_0 = late.start, before_0 = late.start;
  before_0.time = -1024;
  Qss one(late.system, coarse), other(late.system, coarse);
  ASSERT_EQ(one.run(from_0, 2.0, {}).outcome, Outcome::success);
  ASSERT_EQ(other.run(before_0, -1022.0, {}).outcome, Outcome::success);
  EXPECT_LT((from_0.position - before_0.position).norm(), 1e-11);
  EXPECT_EQ(one.work().steps, other.work().steps);
}

TEST(Qss, FollowsForcesOfTheTimeAndFloorsByItsLongestStep) {
  // v = sin t, x = 1 - cos t. The force is expanded every 0.01 s to order 1: cos t is known to 0.01^2 / 2, and the
  // states to a quantum and the growth of its errors over 3 s.
  Problem scene = shaken();
  Qss::Options options = coarse;
  options.quantum = options.velocity_quantum = 1e-5;
  options.max_step = 0.01;
  Qss qss(scene.system, options);
  State<double> state = scene.start;
  ASSERT_EQ(qss.run(state, 3.0, {}).outcome, Outcome::success);
  EXPECT_NEAR(state.velocity(0, 0), std::sin(3.0), 3 * 0.5e-4 + 1e-5);
  EXPECT_NEAR(state.position(0, 0), 1 - std::cos(3.0), 3 * (3 * 0.5e-4 + 1e-5));
  // The floor is noticed by a millisecond late on the way in and out: each moves the speed by k v h^2 / 2 = 5e-5, and
  // the place by a millisecond.
  scene = bounce();
  options.max_step = 0.001;
  Qss onto_floor(scene.system, options);
  state = scene.start;
  ASSERT_EQ(onto_floor.run(state, 2 + std::numbers::pi / 10, {}).outcome, Outcome::success);
  EXPECT_NEAR(state.velocity(0, 0), 1.0, 1e-3);
  EXPECT_NEAR(state.position(0, 0), 1.0, 2e-3);
}

TEST(Qss, RefusesForcesThatChangeUnnoticed) {
  EXPECT_THAT([] { Qss(shaken().system, coarse); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("shaker depends on the time: give a max_step")));
  EXPECT_THAT([] { Qss(bounce().system, coarse); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("floor has a border")));
}

TEST(Qss, RefusesOptionsOutOfRange) {
  const Problem scene = oscillator();
  using Options = Qss::Options;
  for (const Options& bad :
       {Options{.order = 0, .quantum = 1, .velocity_quantum = 1},
        Options{.order = 4, .quantum = 1, .velocity_quantum = 1},
        Options{.quantum = 0, .velocity_quantum = 1}, Options{.quantum = 1, .velocity_quantum = -1},
        Options{.quantum = 1, .velocity_quantum = 1, .max_step = 0},
        Options{.quantum = std::nan(""), .velocity_quantum = 1}})
    EXPECT_THROW(Qss(scene.system, bad), std::invalid_argument);
  Qss qss(scene.system, coarse);
  State<double> state = scene.start;
  EXPECT_THROW(qss.run(state, -1.0, {}), std::invalid_argument);
  RunOptions with_events;
  with_events.events.push_back(level(0.0));
  EXPECT_THAT([&] { qss.run(state, 1.0, with_events); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("one clock for all")));
}

TEST(Qss, SaysWhereTheForceIsSingular) {
  const Problem coincident = falling_together(0.0);
  Qss qss(coincident.system, coarse);
  State<double> state = coincident.start;
  const Report report = qss.run(state, 1.0, {});
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_EQ(report.particle, 0);
  EXPECT_EQ(state.time, 0.0);
}

TEST(Qss, EndsWhereAMotionBlowsUp) {
  // x = 1 / (1 - t), v'' / 2 = 3 (1 - t)^-4: events of v every (1 - t)^2 sqrt(dQ / 3), until that is less than half the
  // last place of the time, 2^-34 at 2^20 s, where 1 - t is 6e-5; 1/(1 - t) sqrt(3/dQ) = 9e5 events to there. The end
  // lies where q has led the motion: some dQ beside 1.
  System<double> system(1, {1.0});
  system.add<CubicPush>({{0}}, {});
  const double begin = 1048576.0;
  State<double> state{begin, Coordinates<double>::Ones(1, 1), Coordinates<double>::Ones(1, 1)};
  Qss qss(system, coarse);
  RunOptions options;
  options.max_steps = 2000000;
  const Report report = qss.run(state, begin + 2, options);
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  EXPECT_EQ(report.particle, 0);
  EXPECT_NEAR(state.time - begin, 1.0, 3e-3);
  EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
}

TEST(Qss, SaysWhereEventsNoLongerChangeTheTime) {
  // At 1e9 s the last place of the time is 1.2e-7 s, in which the velocity changes by 1.2e-7 > dQ.
  Problem scene = oscillator();
  scene.start.time = 1e9;
  Qss qss(scene.system, {.order = 1, .quantum = 1e-9, .velocity_quantum = 1e-9});
  State<double> state = scene.start;
  const Report report = qss.run(state, 1e9 + 1, {});
  EXPECT_EQ(report.outcome, Outcome::step_underflow);
  EXPECT_EQ(report.particle, 0);
  EXPECT_THAT(report.message, HasSubstr("the velocity of particle 0 at t = 1000000000"));
  EXPECT_TRUE(state.position.allFinite());
}

TEST(Qss, StopsAtTheLargestNumberOfStepsAndWhereAsked) {
  const Problem cube = spring_cube(5);
  Qss qss(cube.system, coarse);
  State<double> state = cube.start;
  RunOptions options;
  options.max_steps = 10;
  EXPECT_EQ(qss.run(state, 3.0, options).outcome, Outcome::step_limit);
  EXPECT_EQ(qss.work().steps, 10u);
  RunOptions until_half;
  until_half.observer.after_step = [](const StepView& view) { return view.end() < 0.5; };
  EXPECT_EQ(qss.run(state, 3.0, until_half).outcome, Outcome::interrupted);
  EXPECT_GE(state.time, 0.5);
  EXPECT_LT(state.time, 0.6);
}

}  // namespace
}  // namespace jetlag::testing
