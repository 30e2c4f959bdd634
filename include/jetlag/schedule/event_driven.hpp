// SPDX-License-Identifier: MIT
#pragma once
// The run of schedules with more clocks than one, which go from one event to the next: who is due, and what happens then,
// is a member's to say.
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
  const Work& work() const override { return work_; }

 protected:
  /// clocks: "avi has one for each element"; advice: what to do where max_steps are used up, "take longer steps".
  EventDriven(std::string clocks, std::string advice)
      : clocks_(std::move(clocks)), advice_(std::move(advice)) {}

  /// From this state on, as far as until [s]. Throws std::invalid_argument for one of another shape; false with a report
  /// where it cannot be.
  virtual bool begin(const State<double>& state, double until, Report& report) = 0;
  /// Whether a run that has begun can go on that far.
  virtual bool reaches(double /*until*/) const { return true; }

  /// The time of the next event [s], and from when on it may be taken for due: times are rounded.
  virtual double next_time() const = 0;
  virtual double reach() const { return next_time(); }
  /// All that is due next. False with a report; `last_` is then the time up to which the motion is known.
  virtual bool next_event(const Observer& observer, Report& report) = 0;

  /// Whether the motion agrees with the forces at the end of a run; false with a report.
  virtual bool agrees_at(double /*until*/, Report& /*report*/) { return true; }

  /// The state at a time [s] that is known; at the next event and at `last_`, whose times may be rounded ones.
  virtual State<double> at(double time) const = 0;
  virtual State<double> at_next() const { return at(next_time()); }
  virtual State<double> at_last() const { return at(last_); }
  /// The motion between two events.
  virtual Piece piece(double begin, double end) const = 0;

  double last_ = 0;  // [s]: the last event
  Work work_;

 private:
  class Between;
  Report take_steps(State<double>& state, double until, const RunOptions& options);
  bool continues(const State<double>& state, double until) const;

  std::string clocks_, advice_;
  State<double> handed_out_;
};

}  // namespace jetlag
