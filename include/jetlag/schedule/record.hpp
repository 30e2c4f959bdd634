// SPDX-License-Identifier: MIT
#pragma once
// A run whose whole motion is kept.

#include <utility>

#include "jetlag/motion/trajectory.hpp"
#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

/// Runs a schedule as schedule.run(state, until, options) does, and adds the motion of every step to `trajectory`,
/// which must be empty or end at state.time. Pieces end at the time of the state after the step, so that they meet
/// exactly. Throws std::invalid_argument as Schedule::run and Trajectory::add do.
inline Report record(Schedule& schedule, State<double>& state, double until, Trajectory& trajectory,
                     RunOptions options = {}) {
  auto& after_step = options.observer.after_step;
  after_step = [&trajectory, then = std::move(after_step)](const StepView& view) {
    PieceView piece = view.motion();
    piece.end = view.end();
    trajectory.add(piece);
    return !then || then(view);
  };
  return schedule.run(state, until, options);
}

}  // namespace jetlag
