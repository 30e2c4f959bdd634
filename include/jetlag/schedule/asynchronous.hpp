// SPDX-License-Identifier: MIT
#pragma once
// Free clocks: every particle takes the step that its own motion asks for, whatever its ratio to those of others.
//
// The particle that is due first is updated: its neighbours' polynomials, re-expanded at the present time, are known
// series against which its own is grown. Those due at the very same tick are expanded together, so that who comes
// first does not matter. Then its next step is
//
//     h_i = min(H_i, min_n (e_n - t + o H_n), g min_n h_n),       o = min(1/2, 5/N),
//
// H the step that a particle's own series asks for, e_n where a neighbour's piece ends, N the degree, g the grading. So a
// piece is relied upon beyond its end, but for a part of its step only. A step that may not outlast its neighbours' at all
// would leave no free clocks: it is no longer than theirs, with many neighbours a fraction of that, and clocks stand still
// (measured: 5e6 steps without progress on a chain of 128). With o H_n they cannot: H does not shrink with the steps. The
// last term of a piece, 0.7^N tolerances at its end, has grown to (0.7 (1 + o))^N by then; and errors that neighbours hand
// to each other grow by (1 + o)^N each time, e^5 at most. (Measured on a chain of 20, degree 20, without that limit: the
// energy grows a hundred thousandfold in 50 s; with o = 1/2 by a hundredth, with o = 5/N by 1e-10.)
// What has been relied upon is checked. A new polynomial is compared with the old one at the end of each
// neighbour's step; a neighbour for which such differences add up to more than `notify` tolerances is woken: it is
// updated at once, and counted in Work::wake_ups. Each particle is updated at most once at a tick, so that waking ends.
//
// Source: [MX] algorithm 1, corrected. Block steps (schedule/block.hpp) expand those that are due together.

#include <cstdint>
#include <vector>

#include "jetlag/model/kinks.hpp"
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
  std::int64_t next_after(std::int64_t now) const;
  void notify_neighbours(std::int64_t now);
  bool choose_steps(std::int64_t now, Report& report);

  double grading_, notify_, overlap_;
  EventQueue queue_;
  std::unique_ptr<PartialExpansion> group_;
  std::vector<int> due_;
  std::vector<std::int64_t> step_, natural_;  // of each particle, and what its own series asked for [ticks]
  std::vector<double> doubt_;                 // what its neighbours have departed from what it was told [m]
  std::vector<Kinks::Step> shortened_;
  std::vector<double> expected_;  // where a particle would be at the end of each neighbour's step
};

}  // namespace jetlag
