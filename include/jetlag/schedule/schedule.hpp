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
  const Integrator& integrator;  // piece() is the motion during this step, work() the cost so far
  const State<double>& state;    // at the end of the step
  double begin;                  // [s]
};

struct RunOptions {
  std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();

  /// What to watch for; a step ends at an event that changes the state or ends the run. Without events: no cost.
  std::vector<Event> events;
  /// Where every hit is appended, in order of time; null: nowhere.
  std::vector<EventHit>* hits = nullptr;

  /// Called after every step, after its events; returning false ends the run as `interrupted`.
  std::function<bool(const StepView&)> after_step;
};

class Schedule {
 public:
  virtual ~Schedule() = default;

  /// Moves the state to time `until` exactly. On any outcome but success the state is the last good one.
  virtual Report run(State<double>& state, double until, const RunOptions& options) = 0;

  virtual const Work& work() const = 0;
};

}  // namespace jetlag
