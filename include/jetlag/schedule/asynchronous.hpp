// SPDX-License-Identifier: MIT
#pragma once
// Free clocks: every particle takes the step that its own motion asks for, whatever its ratio to those of others.
//
// The particle that is due first is updated: its neighbours' polynomials, re-expanded at the present time, are known
// series against which its own is grown. Those due at the very same tick are expanded together, so that who comes
// first does not matter. Then its next step is
//
//     h_i = min(h of its own series, g min_n h_n),       n its neighbours,
//
// by the grading g. So a step may outlast the polynomial of a neighbour, which is then relied upon beyond its own end.
// A step that may not would leave no free clocks: cropped at its neighbours' ends it is no longer than theirs, and with
// many neighbours a fraction of that; clocks stand still (measured: 5e6 steps without progress on a chain of 128).
// Instead what has been relied upon is checked. A new polynomial is compared with the old one at the end of each
// neighbour's step; a neighbour for which such differences add up to more than `notify` tolerances is woken: it is
// updated at once, and counted in Work::wake_ups. Each particle is updated at most once at a tick, so that waking ends.
//
// Source: [MX] algorithm 1, corrected. Block steps (schedule/block.hpp) are more accurate at the same cost.

#include <cstdint>
#include <vector>

#include "jetlag/schedule/clock_schedule.hpp"
#include "jetlag/schedule/event_queue.hpp"

namespace jetlag {

class PartialExpansion;

class Asynchronous final : public ClockSchedule {
 public:
  struct Options : ClockOptions {
    double grading = 2;  // g >= 1
    double notify = 1;   // > 0, infinity: never woken
  };

  /// Throws std::invalid_argument.
  Asynchronous(const System<double>& system, TruncationLaw law, const Options& options);
  Asynchronous(const System<double>& system, int degree, const Options& options)
      : Asynchronous(system, fixed_degree(degree), options) {}
  ~Asynchronous() override;

 private:
  void begin_clocks() override;
  std::int64_t due() const override { return queue_.time(); }
  bool update(Report& report) override;
  const std::vector<int>& updated() const override { return due_; }
  std::int64_t step_of(int particle) const override { return step_[particle]; }

  void expected_positions(std::int64_t now);
  void notify_neighbours(std::int64_t now);
  bool choose_steps(std::int64_t now, Report& report);

  double grading_, notify_;
  EventQueue queue_;
  std::unique_ptr<PartialExpansion> group_;
  std::vector<int> due_;
  std::vector<std::int64_t> step_;  // of each particle [ticks]
  std::vector<double> doubt_;       // what its neighbours have departed from what it was told [m]
  std::vector<Kinks::Step> shortened_;
  std::vector<double> expected_;  // where a particle would be at the end of each neighbour's step
};

}  // namespace jetlag
