// SPDX-License-Identifier: MIT
#pragma once
// A schedule: who is due next, until a given time.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/base/courant_frequency.hpp"
#include "jetlag/base/outcome.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/motion/piece.hpp"
#include "jetlag/schedule/events.hpp"

namespace jetlag {

/// What an observer sees after a step. It costs what is asked of it: with a clock for each particle a state or a piece is
/// put together, at O(particles), when it is wanted.
class StepView {
 public:
  StepView(double begin, double end) : begin_(begin), end_(end) {}
  virtual ~StepView() = default;

  double begin() const { return begin_; }  // [s]
  double end() const { return end_; }      // [s]

  /// At the end of the step.
  virtual const State<double>& state() const = 0;
  /// The motion during the step: its begin is that of the step.
  virtual Piece piece() const = 0;
  /// The same where it stands, until the observer returns or asks again. With one clock without a copy where the method has its
  /// coefficients at hand.
  virtual PieceView motion() const {
    kept_ = piece();
    return kept_;
  }
  /// The cost so far.
  virtual const Work& work() const = 0;

 private:
  double begin_, end_;
  mutable Piece kept_;  // of `motion`
};

/// A particle received a new piece.
struct Update {
  int particle;
  double begin, step;  // [s]
  int degree;          // of its position polynomial: the highest order that is not zero
};

/// Who watches a run. What is left empty costs nothing.
struct Observer {
  /// Called after every step that takes time, after its events; returning false ends the run as `interrupted`.
  std::function<bool(const StepView&)> after_step{};

  /// Times [s], ascending, beyond the beginning of the run, at which the state is wanted; and who gets it. It is taken
  /// from the motion itself: no step ends there for its sake.
  std::vector<double> frame_times{};
  std::function<void(const State<double>&)> at_frame{};

  /// Told about every update, those of one particle in order of time, once the length of its step is known and before
  /// any frame beyond its end. Fixed particles may be among them. Costs a piece a step. A step that a neighbour ends
  /// early (`asynchronous`) was told at its full length.
  std::function<void(const Update&)> on_update{};
};

struct RunOptions {
  std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();

  /// Positions [m] and velocities [m/s] beyond which a motion counts as blown up: the run ends as `non_finite` with the
  /// last state that is not. Schedules with one clock heed it.
  double largest = std::numeric_limits<double>::infinity();

  /// What to watch for; a step ends at an event that changes the state or ends the run. Without events: no cost.
  std::vector<Event> events{};
  /// Where every hit is appended, in order of time; null: nowhere.
  std::vector<EventHit>* hits = nullptr;

  Observer observer{};
};

class Schedule {
 public:
  virtual ~Schedule() = default;

  /// Moves the state to time `until` exactly; in lockstep that may be infinity, where a terminal event, max_steps or
  /// after_step ends the run. On any outcome but success the state is the last good one; on `contradicted` the one that the
  /// forces contradict.
  /// Throws std::invalid_argument for a time before that of the state, and for infinity where nothing ends the run.
  virtual Report run(State<double>& state, double until, const RunOptions& options) = 0;

  virtual const Work& work() const = 0;

  /// What the runs so far may have got wrong although they succeeded, in a sentence. Empty: nothing that is known.
  virtual std::string warning() const { return {}; }

  /// What the Courant limit of its steps stands on, if it has one and says so.
  virtual std::optional<CourantFrequency> courant_frequency() const { return std::nullopt; }
};

}  // namespace jetlag
