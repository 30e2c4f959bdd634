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
//
// `until` and frames lie between impulses: positions are those of the straight lines; velocities have of each last
// impulse h F what belongs to times up to t,
//     v(t) = v - sum (1/2 - (t - t_last)/h) h F / m,     over the clocks that push the particle.
// A run begins with half an impulse of every clock. An update is one impulse on one particle; a force evaluation of an
// element is one element coefficient.

#include <cstdint>
#include <string>
#include <vector>

#include "jetlag/model/model.hpp"
#include "jetlag/schedule/event_driven.hpp"

namespace jetlag {

class Impulses : public EventDriven {
 public:
  ~Impulses() override;

 protected:
  /// name: of the method; owner: what has a clock, for messages.
  Impulses(const Model<double>& model, std::string name, std::string owner);

  /// elements: the numbers of those that the clock evaluates, for each law of the model; empty for none.
  /// pushed: the particles that it pushes, ascending, none fixed. step: > 0 and finite, longer than that of the last.
  void add_clock(double step, const std::vector<std::vector<int>>& elements, std::vector<int> pushed);

 private:
  struct Clock;
  struct Due {
    double time;
    int clock;
    friend bool operator>(const Due& a, const Due& b) {
      return a.time > b.time || (a.time == b.time && a.clock > b.clock);
    }
  };

  bool begin(const State<double>& state, double until, Report& report) override;
  double next_time() const override;
  double reach() const override;
  bool next_event(const Observer& observer, Report& report) override;
  State<double> at(double time) const override;
  Piece piece(double begin, double end) const override;
  double together() const;
  bool drift(const Clock& clock, double time, const Observer& observer, Report& report);
  bool push(Clock& clock, double time, double share, Report& report);
  bool schedule(int clock, Report& report);

  Model<double> model_;
  std::string name_;
  int dimension_, stride_;
  std::vector<Clock> clocks_;  // shortest step first
  std::vector<Due> due_;       // a heap: who rings next, ties by number
  std::vector<int> ringing_;   // those that ring now
  // Padded rows: positions and velocities at the particles' own times; forces, zero but while a clock evaluates.
  AlignedVector<double> x_, v_, f_;
  std::vector<double> own_time_;  // [s]
  double origin_ = 0;             // [s]: when the clocks were started
};

}  // namespace jetlag
