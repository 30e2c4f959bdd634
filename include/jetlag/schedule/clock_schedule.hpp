// SPDX-License-Identifier: MIT
#pragma once
// What the schedules with a clock for each particle share: the run, up to who is due and how long its steps are.
//
//     particle 0   |-------------------------------|-------------------------------|
//     particle 1   |---------------|---------------|---------------|---------------|
//     particle 2   |---|---|---|---|-------|-------|---|---|---|---|---|---|---|---|    steps of this run: the times
//                  0   1   2   3   4       6       8                              16    at which somebody is updated
//
// Between updates a particle moves on its own polynomial; whoever is updated sees its neighbours where these are, and
// where they go.
//
//   - Times are whole numbers of ticks: clocks meet exactly, and nothing drifts.
//   - `until` and frames are read from the polynomials, no step is cropped for them. So a run to 1 and on to 2 gives
//     the same bits as a run to 2, and so does one that was stopped on the way, as long as the same schedule is
//     handed the state that it gave. Any other state begins anew.
//   - Events (RunOptions::events) need one clock: they are refused.

#include <cstdint>
#include <memory>

#include "jetlag/schedule/clocks.hpp"
#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

class LocalMotion;

class ClockSchedule : public Schedule {
 public:
  ~ClockSchedule() override;
  Report run(State<double>& state, double until, const RunOptions& options) final;
  const Work& work() const final;

  /// Updates of a particle so far.
  std::uint64_t updates_of(int particle) const;

 protected:
  /// Throws std::invalid_argument.
  ClockSchedule(const System<double>& system, TruncationLaw law, const ClockOptions& options);

  /// All are due at tick 0.
  virtual void begin_clocks() = 0;
  /// The tick of the next update; the largest number where there is none.
  virtual std::int64_t due() const = 0;
  /// Updates those who are due.
  virtual bool update(Report& report) = 0;
  /// Those who have been updated last, and the ticks in the step that each has begun.
  virtual const std::vector<int>& updated() const = 0;
  virtual std::int64_t step_of(int particle) const = 0;

  /// The report for steps that no longer change the time.
  Report underflow(std::int64_t now, const std::vector<int>& particles) const;

  std::unique_ptr<LocalMotion> motion_;

 private:
  bool continues(const State<double>& state, double until) const;
  void begin(const State<double>& state, double until);

  State<double> handed_out_;
};

}  // namespace jetlag
