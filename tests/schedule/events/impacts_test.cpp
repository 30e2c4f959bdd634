// SPDX-License-Identifier: MIT
// Events that change the state: a ball that bounces, until no time lies between its impacts.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/events.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::impacts_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A ball that falls from height 1 with g.
Problem ball(double g) {
  System<double> system(1, {1.0});
  system.add<UniformField>({{0}}, {{-g, 0.0, 0.0}});
  return {std::move(system),
          {0.0, Coordinates<double>::Constant(1, 1, 1.0), Coordinates<double>::Zero(1, 1)}};
}

Event floor_at(double height, double restitution, Direction direction = Direction::falling) {
  return {.name = "floor",
          .g = [height](const auto&, const auto& x, const auto&) { return x(0, 0) - height; },
          .direction = direction,
          .change = [restitution](State<double>& state) { state.velocity(0, 0) *= -restitution; }};
}

Lockstep in_steps(const Problem& scene, double step) {
  return Lockstep(taylor(scene.system, 4, std::make_unique<FixedStep>(step)));
}

/// Impact k = 0, 1, ...: T_0 = sqrt(2/g), then flights of 2 T_0 r^k.
double impact(double g, double r, int k) {
  return std::sqrt(2 / g) * (1 + 2 * r * (1 - std::pow(r, k)) / (1 - r));
}

TEST(Impacts, OfABallComeAtTheTimesOfTheClosedForm) {
  // 30 impacts with restitution 0.9; whatever the steps, and in both directions: the way up never fires. Each impact is
  // at the first double after the truth, ulp(8) = 8 eps at most, with a height and a speed (below g T_0 = 4.5) that are
  // rounded: the flight after it errs by as much. Errors of the speed go on, so that flight k is off by k eps of
  // itself; each step rounds too, of which the longest flight, a tenth of all, takes until / step / 10.
  const double g = 9.81, r = 0.9;
  const Problem scene = ball(g);
  for (const double step : {0.01, 0.3, 20.0})
    for (const Direction direction : {Direction::falling, Direction::any}) {
      std::vector<EventHit> hits;
      RunOptions options;
      options.events = {floor_at(0.0, r, direction)};
      options.hits = &hits;
      State<double> state = scene.start;
      const double until = impact(g, r, 29) + 0.01;
      ASSERT_EQ(in_steps(scene, step).run(state, until, options).outcome, Outcome::success);
      ASSERT_EQ(hits.size(), 30u) << step;
      for (int k = 0; k < 30; ++k) {
        const double truth = impact(g, r, k);
        EXPECT_NEAR(hits[k].time, truth, (k + 1) * (16 + until / step * 0.1 + truth) * eps)
            << step << ", " << k;
        EXPECT_FALSE(hits[k].rising);
      }
    }
}

TEST(Impacts, OfATerminalEventMayBeMadeByTheCaller) {
  const double g = 9.81, r = 0.9;
  const Problem scene = ball(g);
  RunOptions options;
  options.events = {floor_at(0.0, r)};
  options.events[0].change = {};
  options.events[0].terminal = true;
  State<double> state = scene.start;
  Lockstep schedule = in_steps(scene, 0.3);
  for (int k = 0; k < 30; ++k) {
    ASSERT_EQ(schedule.run(state, 100.0, options).outcome, Outcome::event);
    EXPECT_NEAR(state.time, impact(g, r, k), (k + 1) * 50 * eps) << k;
    state.velocity(0, 0) *= -r;
  }
}

TEST(Impacts, KeepTheEnergyOfAnElasticBall) {
  // 1000 impacts: height and speed are rounded at each, and g times the height below the floor is not lost.
  const double g = 2.0;
  const Problem scene = ball(g);
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {floor_at(0.0, 1.0)};
  options.hits = &hits;
  State<double> state = scene.start;
  ASSERT_EQ(in_steps(scene, 5.0).run(state, 2000.0, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 1000u);
  for (int k = 0; k < 1000; ++k) {
    const double energy = g * hits[k].state.position(0, 0) + 0.5 * std::pow(hits[k].state.velocity(0, 0), 2);
    EXPECT_NEAR(energy, 2.0, (k + 1) * 4 * 2 * eps);
    EXPECT_NEAR(hits[k].state.position(0, 0), 0.0,
                2048 * eps * 2.0 + 8 * eps);  // ulp of the time, at speed 2
  }
}

TEST(Impacts, ThatAccumulateEndTheRun) {
  // Zeno: from height H the ball comes to rest at T_0 (1 + r) / (1 - r), T_0 = sqrt(2 H / g), after infinitely many
  // impacts. Flights last 2 T_0 r^k; after 100 that last less than 2^-36 T the run says so. Near -7 positions are
  // rounded to d = 8.9e-16: as long as a flight rises to more than 2^20 d that moves its impact by less than d / v,
  // v > sqrt(2 g 2^20 d) = 1.4e-4, and later not at all. An impact that is late by up to ulp(T) gains g ulp(T) of
  // speed: the flights after it last 2 ulp(T) r / (1 - r) longer.
  const double g = 9.81, r = 0.9;
  const auto at_zero = [](const auto&, const auto& x, const auto&) { return x(0, 0); };
  const auto below = [](const auto&, const auto& x, const auto&) { return x(0, 0) + 7.1; };
  const auto between_doubles = [](const auto&, const auto& x, const auto&) { return 3.0 * x(0, 0) + 20.0; };
  for (const auto& [height, floor] : {std::pair(0.0, Observable(at_zero)),
                                      {-7.1, Observable(below)},
                                      {-20.0 / 3, Observable(between_doubles)}})
    for (const Direction direction : {Direction::falling, Direction::any}) {
      const double first = std::sqrt(2 * (1 - height) / g), rest = first * (1 + r) / (1 - r);
      const double most = std::log(0x1p-36 * rest / (2 * first)) / std::log(r) + 100;
      const Problem scene = ball(g);
      std::vector<EventHit> hits;
      RunOptions options;
      options.events = {floor_at(0.0, r, direction)};
      options.events[0].g = floor;
      options.hits = &hits;
      options.max_steps = 2000;
      State<double> state = scene.start;
      Lockstep schedule = in_steps(scene, 0.3);
      const Report report = schedule.run(state, 100.0, options);
      EXPECT_EQ(report.outcome, Outcome::step_underflow) << height;
      EXPECT_THAT(report.message,
                  AllOf(HasSubstr("event 0 (floor)"), HasSubstr("Zeno"), HasSubstr("100 times")));
      EXPECT_NEAR(static_cast<double>(hits.size()), most, 2);
      const double late = most * rest * eps * (1 + 2 * r / (1 - r));
      EXPECT_NEAR(state.time, rest, late + (height == 0.0 ? 0.0 : 10 * 8.9e-16 / 1.4e-4 / (1 - r)));
      EXPECT_NEAR(state.position(0, 0), height, 1e-14);
    }
}

TEST(Impacts, AtTheSameTimeAreAllMade) {
  // Into a corner along its diagonal: both walls, in the order of their numbers, and back where it came from.
  Problem scene{System<double>(2, {1.0}), {0.0, Coordinates<double>(1, 2), Coordinates<double>(1, 2)}};
  scene.start.position << 1.0, 1.0;
  scene.start.velocity << -1.0, -1.0;
  std::vector<EventHit> hits;
  RunOptions options;
  for (int c = 0; c < 2; ++c)
    options.events.push_back({.name = "wall",
                              .g = [c](const auto&, const auto& x, const auto&) { return x(0, c); },
                              .change = [c](State<double>& state) { state.velocity(0, c) *= -1; }});
  options.hits = &hits;
  State<double> state = scene.start;
  ASSERT_EQ(in_steps(scene, 0.375).run(state, 2.0, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].event, 0);
  EXPECT_EQ(hits[1].event, 1);
  EXPECT_EQ(hits[0].time, 1.0);
  EXPECT_EQ(hits[1].time, 1.0);
  EXPECT_EQ(state.position, scene.start.position);
  EXPECT_EQ(state.velocity, -scene.start.velocity);
}

TEST(Impacts, JumpWithoutFiring) {
  // A sawtooth: x grows with speed 1 and is put back to 0 at 1; the jump passes 1/2 downwards, which is no crossing.
  for (const double step : {0.375, 20.0}) {
    Problem scene{System<double>(1, {1.0}),
                  {0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Ones(1, 1)}};
    std::vector<EventHit> hits;
    RunOptions options;
    options.events = {
        {.name = "full",
         .g = [](const auto&, const auto& x, const auto&) { return x(0, 0) - 1.0; },
         .change = [](State<double>& state) { state.position(0, 0) = 0; }},
        {.name = "half", .g = [](const auto&, const auto& x, const auto&) { return x(0, 0) - 0.5; }}};
    options.hits = &hits;
    State<double> state = scene.start;
    ASSERT_EQ(in_steps(scene, step).run(state, 10.25, options).outcome, Outcome::success);
    ASSERT_EQ(hits.size(), 20u) << step;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_EQ(hits[i].event, i % 2 == 0 ? 1 : 0);
      EXPECT_EQ(hits[i].time, 0.5 * static_cast<double>(i + 1));
      EXPECT_TRUE(hits[i].rising);
    }
    EXPECT_EQ(state.position(0, 0), 0.25);
  }
}

TEST(Impacts, LeaveATrajectoryThatKnowsBothSides) {
  const Problem scene = ball(2.0);  // T_0 = 1
  Trajectory trajectory;
  RunOptions options;
  options.events = {floor_at(0.0, 0.5)};
  State<double> state = scene.start;
  Lockstep schedule = in_steps(scene, 0.375);
  ASSERT_EQ(record(schedule, state, 1.75, trajectory, options).outcome, Outcome::success);
  EXPECT_EQ(trajectory.at(std::nextafter(1.0, 0.0)).velocity(0, 0), -2.0 + eps);
  EXPECT_EQ(trajectory.at(1.0).velocity(0, 0), 1.0);
  EXPECT_NEAR(trajectory.at(1.5).position(0, 0), 0.25, 4 * eps);
  EXPECT_EQ(trajectory.end(), 1.75);
}

TEST(Impacts, WorkWithLeapfrog) {
  // Exact in free fall: its steps are parabolas.
  const double g = 9.81, r = 0.9;
  const Problem scene = ball(g);
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {floor_at(0.0, r)};
  options.hits = &hits;
  State<double> state = scene.start;
  Lockstep schedule(std::make_unique<Leapfrog>(scene.system, 0.03));
  ASSERT_EQ(schedule.run(state, impact(g, r, 9) + 0.01, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 10u);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(hits[k].time, impact(g, r, k), (k + 1) * 100 * eps) << k;
}

TEST(Impacts, MustKeepTimeAndShape) {
  const Problem scene = ball(2.0);
  RunOptions options;
  options.events = {floor_at(0.0, 1.0)};
  State<double> state = scene.start;
  options.events[0].change = [](State<double>& s) { s.time += 1; };
  EXPECT_THAT(
      [&] { in_steps(scene, 0.3).run(state, 2.0, options); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("event 0 (floor): change() must keep the time")));
  state = scene.start;
  options.events[0].change = [](State<double>& s) { s.position = Coordinates<double>::Zero(2, 1); };
  EXPECT_THAT([&] { in_steps(scene, 0.3).run(state, 2.0, options); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("shape (1, 1)")));
}

}  // namespace
}  // namespace jetlag::testing::impacts_test
