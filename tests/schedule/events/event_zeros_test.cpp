// SPDX-License-Identifier: MIT
// Zeros of g do not depend on the steps: also where a step ends on a kink at zero, and where g is zero for a while.

#include <gmock/gmock.h>

#include <limits>
#include <memory>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "schedule/events/events_for_tests.hpp"

namespace jetlag::testing::event_zeros_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// x = t - 1 is rounded by eps / 2 in each of 300 steps at most; a change of a choice is passed by up to 4 (N + 1) roundings,
/// N = 40, of times up to 2: 2 (150 + 164) eps.
constexpr double rounding = 628 * eps;

const Recorded zero = 0.0, minus_one = -1.0;

Lockstep by_jorba_zou() {
  return Lockstep(taylor(free_particle(-1, 1).system, 20, std::make_unique<JorbaZou>()));
}

/// Steps that end on 1, on 3/2, next to them by rounding, or elsewhere.
std::vector<Lockstep> schedules() {
  std::vector<Lockstep> all;
  for (const double step : {0.01, 0.1, 0.2, 0.25, 0.5, 1.0, 0.71, 3.0})
    all.push_back(in_steps(free_particle(-1, 1), step));
  all.push_back(by_jorba_zou());
  return all;
}

/// Those that end on 1, and on 3/2, without rounding.
std::vector<Lockstep> exact_schedules() {
  std::vector<Lockstep> all;
  for (const double step : {0.125, 0.25, 0.5}) all.push_back(in_steps(free_particle(-1, 1), step));
  return all;
}

/// g(t, x) of a particle that moves as x = t - 1.
template <class G>
Event event_of(const G& g) {
  return {.name = "g", .g = [g](const auto& t, const auto& x, const auto&) { return g(t, x(0, 0)); }};
}

struct Zero {
  double time;
  bool rising;
};

void expect_zeros(const std::vector<EventHit>& hits, const std::vector<Zero>& zeros) {
  ASSERT_EQ(hits.size(), zeros.size());
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    EXPECT_NEAR(hits[i].time, zeros[i].time, rounding);
    EXPECT_EQ(hits[i].rising, zeros[i].rising);
  }
}

template <class G>
void expect_zeros(std::vector<Lockstep> steps, const G& g, const std::vector<Zero>& zeros) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SCOPED_TRACE("schedule " + std::to_string(i));
    expect_zeros(hits_of(free_particle(-1, 1), std::move(steps[i]), {event_of(g)}, 3), zeros);
  }
}

const auto odd = [](const auto&, const auto& x) { return x * abs(x); };
/// Negative up to 1, zero up to 3/2, positive from there on.
const auto with_a_rest = [](const auto&, const auto& x) { return max(x - 0.5, 0.0) + min(x, 0.0); };

TEST(EventZeros, OfOddFunctionsWithAKinkAreFoundOnce) {
  expect_zeros(schedules(), odd, {{1, true}});
  expect_zeros(schedules(), [](const auto& t, const auto&) { return (1.0 - t) * abs(t - 1.0); },
               {{1, false}});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return x * sqrt(abs(x)); }, {{1, true}});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return x * pow(abs(x), 0.1); }, {{1, true}});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return cbrt(x); }, {{1, true}});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return select(x < 0.0, x, 2.0 * x); },
               {{1, true}});
  expect_zeros(exact_schedules(), [](const auto&, const auto& x) { return x * x * x * abs(x); }, {{1, true}});
}

TEST(EventZeros, ThatAreTouchedAreNone) {
  expect_zeros(schedules(), [](const auto&, const auto& x) { return abs(x); }, {});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return -abs(x); }, {});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return -sqrt(abs(x)); }, {});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return max(x - 0.5, 0.0) - min(x, 0.0); }, {});
}

TEST(EventZeros, WhereGStaysAreNone) {
  expect_zeros(schedules(), [](const auto&, const auto& x) { return min(x, 0.0); }, {});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return max(x, 0.0); }, {});
}

TEST(EventZeros, ThatAreJumpedToAreNone) {
  expect_zeros(schedules(), [](const auto& t, const auto&) { return select(t < 1.5, minus_one, zero); }, {});
  expect_zeros(schedules(), [](const auto& t, const auto&) { return select(t <= 1.5, minus_one, zero); }, {});
  expect_zeros(schedules(), [](const auto& t, const auto&) { return select(t < 1.5, minus_one, t - 1.5); },
               {});
}

TEST(EventZeros, AreFoundBesideAPoleAtTheEndOfAStep) {
  expect_zeros(schedules(), [](const auto&, const auto& x) { return 1.0 / x - 1.0; }, {{2, false}});
  expect_zeros(schedules(), [](const auto&, const auto& x) { return 1.0 / (x * x) - 4.0; },
               {{0.5, true}, {1.5, false}});
}

TEST(EventZeros, ThatLastAreCrossedWhereTheyAreLeft) {
  expect_zeros(schedules(), with_a_rest, {{1.5, true}});
  expect_zeros(schedules(), [](const auto& t, const auto& x) { return -with_a_rest(t, x); }, {{1.5, false}});
  for (Lockstep& schedule : schedules()) {
    Event falling = event_of(with_a_rest);
    falling.direction = Direction::falling;
    expect_zeros(hits_of(free_particle(-1, 1), std::move(schedule), {falling}, 3), {});
  }
}

TEST(EventZeros, BesideASingularPointAtTheEndOfAStepAreFound) {
  // Two particles meet at t = 1: their distance is 2 |t - 1|, 1/2 at 3/4 and at 5/4.
  Problem scene{System<double>(2, {1.0, 1.0}), {0.0, Coordinates<double>(2, 2), Coordinates<double>(2, 2)}};
  scene.start.position << -1.0, 0.0, 1.0, 0.0;
  scene.start.velocity << 1.0, 0.0, -1.0, 0.0;
  const Event near{.name = "near", .g = [](const auto&, const auto& x, const auto&) {
                     const auto dx = x(1, 0) - x(0, 0), dy = x(1, 1) - x(0, 1);
                     return sqrt(dx * dx + dy * dy) - 0.5;
                   }};
  for (const double step : {0.1, 0.25, 0.5, 1.0, 2.0})
    expect_zeros(hits_of(scene, in_steps(scene, step), {near}, 2.0), {{0.75, false}, {1.25, true}});
}

// ---- runs that are parted ------------------------------------------------------------------------------------

/// What two runs hit, the first one to a time, or to its end before.
std::vector<EventHit> hits_of_two_runs(Lockstep schedule, Event event, double until, Outcome first) {
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = {std::move(event)};
  options.hits = &hits;
  State<double> state = free_particle(-1, 1).start;
  EXPECT_EQ(schedule.run(state, until, options).outcome, first);
  EXPECT_EQ(schedule.run(state, 3.0, options).outcome, Outcome::success);
  return hits;
}

TEST(EventZeros, AtTheEndOfARunBelongToIt) {
  for (Lockstep& schedule : exact_schedules())
    expect_zeros(hits_of_two_runs(std::move(schedule), event_of(odd), 1.0, Outcome::success), {{1, true}});
}

TEST(EventZeros, OnWhichARunBeginsAreLeftWithoutFiring) {  // it does not know from where g has come
  for (Lockstep& schedule : exact_schedules())
    expect_zeros(hits_of_two_runs(std::move(schedule), event_of(with_a_rest), 1.25, Outcome::success), {});
}

TEST(EventZeros, ThatEndARunEndItOnce) {
  Event at_one = event_of(odd), after_rest = event_of(with_a_rest);
  at_one.terminal = after_rest.terminal = true;
  for (Lockstep& schedule : schedules())
    expect_zeros(hits_of_two_runs(std::move(schedule), at_one, 3.0, Outcome::event), {{1, true}});
  for (Lockstep& schedule : schedules())
    expect_zeros(hits_of_two_runs(std::move(schedule), after_rest, 3.0, Outcome::event), {{1.5, true}});
}

// ---- beside events that change the state ----------------------------------------------------------------------

TEST(EventZeros, ThatLastAreKeptThroughAChangeThatLeavesThem) {
  int number = 0;
  for (Lockstep& schedule : schedules()) {
    SCOPED_TRACE("schedule " + std::to_string(number++));
    Event change = level(0.2);
    change.change = [](State<double>&) {};
    const auto hits = hits_of(free_particle(-1, 1), std::move(schedule), {change, event_of(with_a_rest)}, 3);
    expect_zeros(hits, {{1.2, true}, {1.5, true}});
  }
}

TEST(EventZeros, OfAnImpactAreSeenOnceByWhoOnlyLooks) {
  // From -1 to the wall at 0 and back; both events have the same g, the second changes nothing.
  for (Lockstep& schedule : exact_schedules()) {
    Event wall = level(0.0, Direction::rising);
    wall.change = [](State<double>& state) { state.velocity(0, 0) *= -1; };
    const auto hits = hits_of(free_particle(-1, 1), std::move(schedule), {wall, level(0.0)}, 3);
    expect_zeros(hits, {{1, true}, {1, true}});
  }
}

}  // namespace
}  // namespace jetlag::testing::event_zeros_test
