// SPDX-License-Identifier: MIT
#pragma once
// Watches a run, step by step, for its events.
//
// A step has crossed an event as often as the sign of g changes from the state at its beginning to the state at its
// end, and where the polynomial of g says. The states decide: a run that is interrupted and taken up again sees the
// same states, so it finds each crossing once, whatever rounding does to the polynomials at the ends of the steps. A
// step that is cut at a terminal event whose state is, by rounding, not yet beyond it is taken up by another one, and
// found there.
//
// Where g of the state is zero, the motion carried on a little beyond the step tells where g goes. Where g stays at zero
// there, the sign that it had before is kept for the steps to come.

#include <string>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

class EventWatch {
 public:
  /// Keeps a reference to the options. Throws std::invalid_argument for an event that reads what does not exist.
  EventWatch(const RunOptions& options, const State<double>& start);

  bool idle() const { return events_.empty(); }

  /// Looks at a step, a piece that ends with it; `state` is where it has led. Hands out the hits in order; where an event changes the state or
  /// ends the run, `state` is taken back to it. Success: the run goes on from `state`. Outcome::event: it ends there.
  /// Any other: it cannot go on, and `state` is that at the beginning of the step.
  Report look(const PieceView& piece, State<double>& state);

 private:
  /// One event during the step that is looked at.
  struct Watched {
    const Event& event;
    ObservableSeries g;
    std::string name;
    std::vector<LocalSeries> series{};  // of g along the step
    int side = 0;                       // the sign of g right after the beginning of the step
    std::vector<Crossing> crossings{};  // in order, whether they count or not
    bool on_event = false;              // at the beginning: it has just fired and g is still zero
    int before = 0;                     // at the beginning, where g is zero: the sign that it has had last
    bool stays = false;                 // whether g stays at zero there, as far as is known

    /// Whether it is sure at a glance that g keeps its sign, which is taken along.
    bool keeps_sign(const PieceView& piece, const State<double>& state);
    bool counts(const Crossing& at) const;
    bool leaves() const { return event.terminal || event.change; }
    const LocalSeries& series_at(double t) const;
    const LocalSeries& series_from(double t) const;
    int sign_after(double t) const;
    void find_crossings();
    struct Ahead {
      double time, value;
    };
    Ahead ahead(double t, const PieceView& piece);
    int sign_from_zero(double t, const Ahead& ahead) const;
    bool take_back_crossing_at(double t, double rounding);
    void settle(double t, const State<double>& state, const PieceView& piece);
  };
  struct Hit {
    int event;
    Crossing at;
  };

  double last_time(double end) const;
  std::vector<Hit> all_hits() const;
  void hand_out(const Hit& hit, const State<double>& state);
  void change(const std::vector<Hit>& hits, State<double>& state);

  std::vector<Watched> events_;
  std::vector<EventHit>* hits_;
  int instants_ = 0;  // changes in a row with next to no time in between
};

}  // namespace jetlag
