// SPDX-License-Identifier: MIT
// Events that end a run, and runs that events cannot follow.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/schedule/events.hpp"
#include "jetlag/series/elementary.hpp"
#include "schedule/events/events_for_tests.hpp"

namespace jetlag::testing::event_outcomes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

TEST(Events, EndARunThatHasNoOtherEnd) {  // a fall from 1 m; half of a period
  constexpr double infinity = std::numeric_limits<double>::infinity();
  System<> falling(1, {1.0});
  falling.add<UniformField>({{0}}, {{-9.8, 0.0, 0.0}});
  const Problem scenes[] = {{falling, {0.0, Coordinates<>::Ones(1, 1), Coordinates<>::Zero(1, 1)}},
                            oscillator()};
  const double ends[] = {std::sqrt(2 / 9.8), 0.5 * pi};
  for (int i = 0; i < 2; ++i) {
    RunOptions options;
    options.events = {level(0.0, Direction::falling)};
    options.events[0].terminal = true;
    State<double> state = scenes[i].start;
    Lockstep schedule(taylor(scenes[i].system, 20, std::make_unique<JorbaZou>()));
    EXPECT_EQ(schedule.run(state, infinity, options).outcome, Outcome::event);
    EXPECT_NEAR(state.time, ends[i], 4 * eps);  // rounding of x, of speed 1 or more, in a step or two
  }
}

TEST(Events, ARunWithoutAnyEndIsRefused) {
  State<double> state = oscillator().start;
  EXPECT_THROW(in_steps(oscillator(), 0.3).run(state, std::numeric_limits<double>::infinity(), RunOptions{}),
               std::invalid_argument);
}

TEST(Events, EndARunWhereTheyAreTerminal) {
  const Problem scene = oscillator();
  std::vector<EventHit> hits;
  int steps = 0;
  RunOptions options;
  options.events = {level(0.5), level(0.0, Direction::falling)};
  options.events[1].name = "the middle";
  options.events[1].terminal = true;
  options.hits = &hits;
  options.observer.after_step = [&](const StepView& view) {
    steps += view.end() == 0.5 * pi || std::abs(view.end() - 0.5 * pi) < 1e-14;
    return true;
  };
  State<double> state = scene.start;
  Lockstep schedule = in_steps(scene, 0.3);
  for (int k = 0; k < 5; ++k) {  // and the run goes on, without another hit
    const Report report = schedule.run(state, 100.0, options);
    EXPECT_EQ(report.outcome, Outcome::event);
    EXPECT_STREQ(to_string(report.outcome), "event");
    EXPECT_THAT(report.message, AllOf(HasSubstr("event 1 (the middle)"), HasSubstr("t = ")));
    EXPECT_EQ(hits.size(), k == 0 ? 2u : 2u + 3u * k);
    EXPECT_EQ(hits.back().event, 1);
    EXPECT_EQ(state.time, hits.back().time);
    EXPECT_EQ(state.position, hits.back().state.position);
    EXPECT_LE(state.position(0, 0), 0.0);
    const double truth = (2 * k + 0.5) * pi;
    EXPECT_NEAR(state.time, truth, (std::sqrt(2.0) * (truth / 0.3 + 2 * k + 1) + 2 * truth + 20) * eps);
  }
  EXPECT_EQ(steps, 1);  // the step to the event is shown too
}

TEST(Events, EndARunOnceWhereverRoundingPutsThem) {
  // A terminal event at levels all over the swing, passed 20 times each way: state after state is on the new side,
  // or on the event.
  const Problem scene = oscillator();
  for (const double height : {-0.99, -0.3, 0.0, 0.1, 0.77, 0.999}) {
    RunOptions options;
    options.events = {level(height)};
    options.events[0].terminal = true;
    std::vector<EventHit> hits;
    options.hits = &hits;
    State<double> state = scene.start;
    Lockstep schedule = in_steps(scene, 0.3);
    int count = 0;
    while (schedule.run(state, 40 * pi, options).outcome == Outcome::event) {
      ++count;
      EXPECT_GE((count % 2 == 1 ? 1 : -1) * (height - state.position(0, 0)), 0.0) << height << ", " << count;
      EXPECT_EQ(state.time, hits.back().time);
      ASSERT_LE(count, 40);
    }
    EXPECT_EQ(count, 40) << height;
  }
}

TEST(Events, SayWhereTheirFunctionDoesNotExist) {
  // sqrt(x) beyond x = 0, at t = pi/2, and log from the start: the state before that step is left.
  const Problem scene = oscillator();
  const Event root{.name = "root",
                   .g = [](const auto&, const auto& x, const auto&) { return sqrt(x(0, 0)) - 2.0; }};
  const Event log_of{.name = "log",
                     .g = [](const auto&, const auto& x, const auto&) { return log(x(0, 0) - 3.0); }};
  const Event all{.name = "infinite",
                  .g = [](const auto&, const auto& x, const auto&) { return 1.0 / (x(0, 0) * 0.0); }};
  for (const auto& [event, time] : {std::pair(root, 1.5), std::pair(log_of, 0.0), std::pair(all, 0.0)}) {
    RunOptions options;
    options.events = {event};
    State<double> state = scene.start;
    const Report report = in_steps(scene, 0.25).run(state, 10.0, options);
    EXPECT_EQ(report.outcome, Outcome::non_finite);
    EXPECT_THAT(report.message,
                AllOf(HasSubstr("event 0 (" + event.name + ")"), HasSubstr("no series at t = ")));
    EXPECT_EQ(state.time, time);
    EXPECT_NEAR(state.position(0, 0), std::cos(time), 20 * eps);
  }
}

TEST(Events, MayEndARunBeforeTheirFunctionCeasesToExist) {
  const Problem scene = oscillator();
  RunOptions options;
  options.events = {
      {.name = "root", .g = [](const auto&, const auto& x, const auto&) { return sqrt(x(0, 0)) - 0.01; }}};
  options.events[0].terminal = true;
  State<double> state = scene.start;
  const Report report = in_steps(scene, 0.25).run(state, 10.0, options);
  EXPECT_EQ(report.outcome, Outcome::event);
  EXPECT_NEAR(state.time, std::acos(1e-4), 20 * eps);
}

TEST(Events, BeforeTheirFunctionCeasesToExistAreHandedOut) {
  // sqrt(cos t) = 1/100 at acos(1e-4), 1e-4 s before pi/2, in the same step; the run ends there, and knows it.
  const Problem scene = oscillator();
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {
      {.name = "root", .g = [](const auto&, const auto& x, const auto&) { return sqrt(x(0, 0)) - 0.01; }}};
  options.hits = &hits;
  State<double> state = scene.start;
  EXPECT_EQ(in_steps(scene, 0.25).run(state, 10.0, options).outcome, Outcome::non_finite);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].time, std::acos(1e-4), 20 * eps);
  EXPECT_FALSE(hits[0].rising);
}

TEST(Events, RefuseWhatDoesNotExist) {
  const Problem scene = oscillator();
  RunOptions options;
  options.events = {level(0.0),
                    {.name = "other", .g = [](const auto&, const auto& x, const auto&) { return x(1, 0); }}};
  State<double> state = scene.start;
  EXPECT_THAT(
      [&] { in_steps(scene, 0.25).run(state, 10.0, options); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("event 1 (other)"), HasSubstr("x(1, 0)"))));
}

}  // namespace
}  // namespace jetlag::testing::event_outcomes_test
