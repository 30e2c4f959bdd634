// SPDX-License-Identifier: MIT
#pragma once
// A schedule: who is due next, until a given time.

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "jetlag/integrators/integrator.hpp"
#include "jetlag/schedule/events.hpp"

namespace jetlag {

/// What an observer sees after each step.
struct StepView {
  const LastStep& integrator;  // piece() is the motion during this step, work() the cost so far
  const State<double>& state;  // at the end of the step
  double begin;                // [s]
};

/// A particle received a new piece.
struct Update {
  int particle;
  double begin, step;  // [s]
  int degree;          // of its position polynomial: the highest order that is not zero
};

struct RunOptions {
  std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();

  /// Positions [m] and velocities [m/s] beyond which a motion counts as blown up: the run ends as `non_finite` with the
  /// last state that is not. Schedules with one clock heed it.
  double largest = std::numeric_limits<double>::infinity();

  /// What to watch for; a step ends at an event that changes the state or ends the run. Without events: no cost.
  std::vector<Event> events;
  /// Where every hit is appended, in order of time; null: nowhere.
  std::vector<EventHit>* hits = nullptr;

  /// Called after every step, after its events; returning false ends the run as `interrupted`. With a clock for each
  /// particle the state is put together for it: that costs O(particles) a step, and nothing where nobody asks.
  std::function<bool(const StepView&)> after_step;

  /// As after_step, but told the time only, which costs nothing.
  std::function<bool(double time)> go_on;

  /// Times [s], ascending, beyond the beginning of the run, at which the state is wanted; and who gets it. It is taken
  /// from the motion itself: no step ends there for its sake.
  std::vector<double> frame_times;
  std::function<void(const State<double>&)> at_frame;

  /// Told about every update, those of one particle in order of time, once the length of its step is known and before
  /// any frame beyond its end. Fixed particles may be among them. Costs a piece a step; nothing where nobody asks. A step
  /// that a neighbour ends early (`asynchronous`) was told at its full length.
  std::function<void(const Update&)> on_update;
};

class Schedule {
 public:
  virtual ~Schedule() = default;

  /// Moves the state to time `until` exactly. On any outcome but success the state is the last good one.
  virtual Report run(State<double>& state, double until, const RunOptions& options) = 0;

  virtual const Work& work() const = 0;
};

}  // namespace jetlag
