// SPDX-License-Identifier: MIT
// Where it is close: events at the ends of steps and runs are found once, what only touches is not found.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/schedule/events.hpp"
#include "schedule/events/events_for_tests.hpp"

namespace jetlag::testing::event_borders_test {
namespace {

using ::testing::IsEmpty;

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Events, AtTheEndOfAStepAreFoundOnce) {
  // x = t - 1 in steps of 1/8 is zero where two steps meet, without rounding; a run may end there too.
  const Problem scene = free_particle(-1.0, 1.0);
  EXPECT_EQ(hits_of(scene, in_steps(scene, 0.125), {level(0.0)}, 2.0).size(), 1u);
  EXPECT_EQ(hits_of(scene, in_steps(scene, 0.125), {level(0.0)}, 2.0)[0].time, 1.0);
  ASSERT_EQ(hits_of(scene, in_steps(scene, 0.125), {level(0.0)}, 1.0).size(), 1u);
  const Problem after = free_particle(0.0, 1.0);
  EXPECT_THAT(hits_of(after, in_steps(after, 0.125), {level(0.0)}, 1.0), IsEmpty());
}

TEST(Events, WithinRoundingOfTheEndOfAStepAreFoundOnce) {
  // Levels are what an oscillator has at the ends of its steps, and the doubles beside it: by rounding the polynomials
  // cross before the end or after it. One run finds each once; so do two runs that part there, together.
  const Problem scene = oscillator();
  for (const int degree : {8, 20})
    for (int step = 1; step <= 10; ++step) {  // cos t falls until t = pi > 3
      State<double> there = scene.start;
      ASSERT_EQ(in_steps(scene, 0.3, degree).run(there, 0.3 * step, {}).outcome, Outcome::success);
      const double x = there.position(0, 0);
      for (const double height : {std::nextafter(x, -2.0), x, std::nextafter(x, 2.0)}) {
        EXPECT_EQ(hits_of(scene, in_steps(scene, 0.3, degree), {level(height)}, 3.1).size(), 1u) << step;
        std::vector<EventHit> hits;
        RunOptions options;
        options.events = {level(height)};
        options.hits = &hits;
        State<double> state = scene.start;
        Lockstep schedule = in_steps(scene, 0.3, degree);
        ASSERT_EQ(schedule.run(state, 0.3 * step, options).outcome, Outcome::success);
        ASSERT_EQ(schedule.run(state, 3.1, options).outcome, Outcome::success);
        ASSERT_EQ(hits.size(), 1u) << "step " << step << ", level " << height - x << " from the state";
        EXPECT_NEAR(hits[0].time, 0.3 * step, 10 * eps / std::sin(0.3 * step) + 4 * eps);
      }
    }
}

TEST(Events, AreCountedWhateverHappensAtTheEndsOfSteps) {
  // As above in steps of 5/2, where a level is often crossed within the step and again at its end: as often in (0, 26)
  // as cos t = level, t = 2 pi m +- acos(level).
  const Problem scene = oscillator();
  for (int step = 1; step <= 10; ++step) {
    State<double> there = scene.start;
    ASSERT_EQ(in_steps(scene, 2.5, 30).run(there, 2.5 * step, {}).outcome, Outcome::success);
    const double x = there.position(0, 0);
    std::size_t expected = 0;
    for (int m = 0; m <= 5; ++m)
      for (const int side : {-1, 1}) {
        const double t = 2 * std::numbers::pi * m + side * std::acos(x);
        expected += 0 < t && t < 26;
      }
    for (const double height : {x - 2 * eps, std::nextafter(x, -2.0), x, std::nextafter(x, 2.0), x + 2 * eps})
      EXPECT_EQ(hits_of(scene, in_steps(scene, 2.5, 30), {level(height)}, 26.0).size(), expected) << step;
  }
}

TEST(Events, DoNotFireWhereARunBeginsOnThem) {
  for (const double velocity : {1.0, -1.0}) {
    const Problem scene = free_particle(0.5, velocity);
    EXPECT_THAT(hits_of(scene, in_steps(scene, 0.25), {level(0.5)}, 1.0), IsEmpty());
  }
}

/// Thrown up from 0 at speed v, falling with g: the top is v^2 / (2g), after v / g.
Problem thrown(double v, double g) {
  System<double> system(1, {1.0});
  system.add<UniformField>({{0}}, {{-g, 0.0, 0.0}});
  return {std::move(system), {0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Constant(1, 1, v)}};
}

TEST(Events, DoNotFireWhereTheMotionTouches) {
  // Within a step, and where steps meet without rounding; 1e-12 below the top there are two crossings.
  for (const auto& [v, g, step] :
       {std::array{1.0, 3.0, 1.5}, {2.0, 2.0, 1.5}, {0.7, 9.81, 1.5}, {2.0, 2.0, 0.25}}) {
    const Problem scene = thrown(v, g);
    const double top = v * v / (2 * g);
    EXPECT_THAT(hits_of(scene, in_steps(scene, step), {level(top)}, 1.5), IsEmpty()) << g << ", " << step;
    EXPECT_EQ(hits_of(scene, in_steps(scene, step), {level(top - 1e-12)}, 1.5).size(), 2u)
        << g << ", " << step;
    EXPECT_THAT(hits_of(scene, in_steps(scene, step), {level(top)}, 1.0), IsEmpty()) << g << ", " << step;
  }
}

TEST(Events, DoNotFireWhereNothingMoves) {
  const Problem scene = oscillator();
  const Event zero{.name = "zero",
                   .g = [](const auto&, const auto& x, const auto&) { return x(0, 0) - x(0, 0); }};
  const Event constant{.name = "constant", .g = [](const auto&, const auto&, const auto&) { return 0.0; }};
  EXPECT_THAT(hits_of(scene, in_steps(scene, 0.3), {zero, constant}, 10.0), IsEmpty());
}

}  // namespace
}  // namespace jetlag::testing::event_borders_test
