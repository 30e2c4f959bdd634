// SPDX-License-Identifier: MIT
#pragma once
// A clock for each particle: what the schedules of this kind share is the motion and its ticks; who is due, and how long
// its steps are, is a member's to say.
//
//     particle 0   |-------------------------------|-------------------------------|
//     particle 1   |---------------|---------------|---------------|---------------|
//     particle 2   |---|---|---|---|-------|-------|---|---|---|---|---|---|---|---|    steps of this run: the times
//                  0   1   2   3   4       6       8                              16    at which somebody is updated
//
// Between updates a particle moves on its own polynomial; whoever is updated sees its neighbours where these are, and
// where they go. Times are whole numbers of ticks: clocks meet exactly, and nothing drifts. An update at `until` belongs
// to the next run.

#include <cstdint>
#include <memory>

#include "jetlag/schedule/clock_options.hpp"
#include "jetlag/schedule/event_driven.hpp"

namespace jetlag {

class LocalMotion;

class ParticleClocks : public EventDriven {
 public:
  ~ParticleClocks() override;
  const Work& work() const final;
  std::optional<CourantFrequency> courant_frequency() const final;

  /// Updates of a particle so far.
  std::uint64_t updates_of(int particle) const;

 protected:
  /// Throws std::invalid_argument.
  ParticleClocks(const System<double>& system, TruncationLaw law, const ClockOptions& options);

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
  Report sliding(std::int64_t now, int particle) const;

  std::unique_ptr<LocalMotion> motion_;

 private:
  bool begin(const State<double>& state, double until, Report& report) final;
  bool reaches(double until) const final;
  double next_time() const final;
  double reach() const final;
  bool next_event(const Observer& observer, Report& report) final;
  bool agrees_at(double until, Report& report) final;
  State<double> at(double time) const final;
  State<double> at_next() const final;
  State<double> at_last() const final;
  Piece piece(double begin, double end) const final;

  std::int64_t last_tick_ = 0;  // of the time last_
};

}  // namespace jetlag
