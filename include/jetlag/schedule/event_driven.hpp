// SPDX-License-Identifier: MIT
#pragma once
// The run of a schedule that goes from one event to the next: who is due, and what happens then, is a member's to say.
//
//   - Between events the motion is known: `until` and frames are read off it, no event is moved for them. So a run to 1
//     and on to 2 gives the bits of a run to 2, and so does one that was stopped on the way, as long as the schedule is
//     handed the state that it gave. Any other state begins anew.
//   - A step, for max_steps and observers, lasts from one event to the next, whosever it is.
//   - RunOptions::events need one clock for all particles: they are refused.

#include <string>

#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

class EventDriven : public Schedule {
 public:
  /// Throws std::invalid_argument as Schedule::run does, and for events.
  Report run(State<double>& state, double until, const RunOptions& options) final;
  const Work& work() const final { return work_; }

 protected:
  /// clocks: "avi has one for each element"; advice: what to do where max_steps are used up, "take longer steps".
  EventDriven(std::string clocks, std::string advice)
      : clocks_(std::move(clocks)), advice_(std::move(advice)) {}

  /// From this state on. Throws std::invalid_argument for one of another shape; false with a report where it cannot be.
  virtual bool begin(const State<double>& state, Report& report) = 0;
  /// The time of the next event [s], and from when on it may be taken for due: times are rounded.
  virtual double next_time() const = 0;
  virtual double reach() const { return next_time(); }
  /// All that is due next. False with a report; `last_` is then the time up to which the motion is known.
  virtual bool next_event(const RunOptions& options, Report& report) = 0;
  virtual State<double> at(double time) const = 0;
  /// The motion between two events.
  virtual Piece piece(double begin, double end) const = 0;

  double last_ = 0;  // [s]: the last event
  Work work_;

 private:
  class Between;
  bool continues(const State<double>& state) const;

  std::string clocks_, advice_;
  State<double> handed_out_;
};

}  // namespace jetlag
