// SPDX-License-Identifier: MIT
#pragma once
// Clocks that push: particles move on straight lines and receive an impulse from a clock whenever that rings.
//
//     clock 0   |-------|-------|-------|-------|-------|      h_0 F / m on the velocities of its particles
//     clock 1   |------------|------------|------------|       h_1 F / m
//
// What is the same for all methods of this kind is here; a member says which elements a clock evaluates and which
// particles it pushes. Clocks of equal steps are one. A clock rings at  origin + n step,  n = 1, 2, .. , rounded once, so
// that nothing drifts; clocks whose times are equal but for rounding ring together, in the order of their steps. All that
// ring move their particles first and push afterwards: an impulse sees every other particle where its line has taken it,
// and none beyond the end of its step, for it is the earliest clock that rings.

#include <cstdint>
#include <string>
#include <vector>

#include "jetlag/schedule/schedule.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

class Impulses : public Schedule {
 public:
  ~Impulses() override;

  /// `until` and frames lie between impulses: positions are those of the straight lines; velocities have of each last
  /// impulse h F what belongs to times up to t,
  ///     v(t) = v - sum (1/2 - (t - t_last)/h) h F / m,     over the clocks that push the particle.
  /// The clocks go on as if nobody had looked: as long as it is handed the state that it gave, a run to 1 and on to 2
  /// gives the bits of a run to 2. Any other state begins anew, with half an impulse of every clock.
  ///
  /// A step, for max_steps and observers, lasts from one impulse to the next, whosever it is. Events need one clock for
  /// all: they are refused. Throws std::invalid_argument as Schedule::run does, and for events.
  Report run(State<double>& state, double until, const RunOptions& options) override;

  /// An update is one impulse on one particle; a force evaluation of an element is one element coefficient.
  const Work& work() const override { return work_; }

 protected:
  /// name: of the method; owner: what has a clock, for messages.
  Impulses(const System<double>& system, std::string name, std::string owner);

  /// elements: the numbers of those that the clock evaluates, for each group of System::elements(); empty for none.
  /// pushed: the particles that it pushes, ascending, none fixed. step: > 0 and finite, longer than that of the last.
  void add_clock(const System<double>& system, double step, const std::vector<std::vector<int>>& elements,
                 std::vector<int> pushed);

 private:
  class Between;
  struct Clock;
  struct Due {
    double time;
    int clock;
    friend bool operator>(const Due& a, const Due& b) {
      return a.time > b.time || (a.time == b.time && a.clock > b.clock);
    }
  };

  bool continues(const State<double>& state) const;
  bool begin(const State<double>& state, Report& report);
  bool is_due(double time) const { return reach() <= time; }
  double reach() const;
  double next_time() const;
  double together() const;
  bool next_impulses(const RunOptions& options, Report& report);
  bool drift(const Clock& clock, double time, const RunOptions& options, Report& report);
  bool push(Clock& clock, double time, double share, Report& report);
  bool schedule(int clock, Report& report);
  State<double> at(double time) const;

  std::string name_, owner_;
  int dimension_, stride_;
  std::vector<double> push_;   // 1/m, 0 of fixed particles
  std::vector<Clock> clocks_;  // shortest step first
  std::vector<Due> due_;       // a heap: who rings next, ties by number
  std::vector<int> ringing_;   // those that ring now
  // Padded rows: positions and velocities at the particles' own times; forces, zero but while a clock evaluates.
  AlignedVector<double> x_, v_, f_;
  std::vector<double> own_time_;  // [s]
  double origin_ = 0, last_ = 0;  // [s]: when the clocks were started, when the last one rang
  State<double> handed_out_;
  Work work_;
};

}  // namespace jetlag
