// SPDX-License-Identifier: MIT
#pragma once
// What the tests of events share.

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/events.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {

inline Lockstep in_steps(const Problem& scene, double step, int degree = 20) {
  return Lockstep(taylor(scene.system, degree, std::make_unique<FixedStep>(step)));
}

/// g = x(0, 0) - level.
inline Event level(double height, Direction direction = Direction::any) {
  return {.name = "level",
          .g = [height](const auto&, const auto& x, const auto&) { return x(0, 0) - height; },
          .direction = direction};
}

/// What a run to `until` hits.
inline std::vector<EventHit> hits_of(const Problem& scene, Lockstep schedule, std::vector<Event> events,
                                     double until) {
  std::vector<EventHit> hits;
  RunOptions options;
  options.events = std::move(events);
  options.hits = &hits;
  State<double> state = scene.start;
  EXPECT_EQ(schedule.run(state, until, options).outcome, Outcome::success);
  EXPECT_EQ(state.time, until);
  return hits;
}

/// A free particle on a line: x = position + velocity t, without rounding at these numbers.
inline Problem free_particle(double position, double velocity) {
  return {
      System<double>(1, {1.0}),
      {0.0, Coordinates<double>::Constant(1, 1, position), Coordinates<double>::Constant(1, 1, velocity)}};
}

}  // namespace jetlag::testing
