// SPDX-License-Identifier: MIT
#pragma once
// What schedules with a clock for each particle have in common: how a particle is moved, and how long its steps are.

#include <cstdint>
#include <limits>

#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/velocity_series.hpp"

namespace jetlag {

struct ClockOptions {
  double tolerance = 1e-9;  // [m] > 0: of a step, as in control/last_two.hpp
  double max_step = std::numeric_limits<double>::infinity();  // [s] > 0
  /// In (0, 1]: a fraction of the Courant limit of each particle that its steps do not exceed; 0: none. Where a law has no
  /// stiffness, that is the limit of a state, 5 % shorter: of the beginning of a run, and again when particles have been
  /// updated 50 times in the mean. Leave room for what stiffens sooner.
  double courant = 0;
  VelocitySeries velocity = VelocitySeries::own_series;

  /// Random degrees: one draw for all particles that are updated together, or one for each.
  bool shared_draw = true;
  std::uint64_t seed = 1;
  Draw draws = Draw::independent;  // not stratified: strata are over particles of one update

  /// Threads that expand a large scene when all its particles are due, >= 1; the result does not depend on them.
  int threads = 1;
};

}  // namespace jetlag
