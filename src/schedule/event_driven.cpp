// SPDX-License-Identifier: MIT
#include "jetlag/schedule/event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "schedule/observing.hpp"

namespace jetlag {

/// What an observer sees of the motion between two events.
class EventDriven::Between final : public StepView {
 public:
  Between(const EventDriven& motion, double begin, double end, bool ends_at_event)
      : StepView(begin, end), motion_(motion), ends_at_event_(ends_at_event) {}
  const State<double>& state() const override {
    if (!state_) state_ = ends_at_event_ ? motion_.at_next() : motion_.at(end());
    return *state_;
  }
  Piece piece() const override { return motion_.piece(begin(), end()); }
  const Work& work() const override { return motion_.work(); }

 private:
  const EventDriven& motion_;
  bool ends_at_event_;
  mutable std::optional<State<double>> state_;
};

bool EventDriven::continues(const State<double>& state, double until) const {
  const auto same = [](const Coordinates<double>& a, const Coordinates<double>& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  };
  return handed_out_.position.size() > 0 && state.time == handed_out_.time &&
         same(state.position, handed_out_.position) && same(state.velocity, handed_out_.velocity) &&
         reaches(until);
}

Report EventDriven::run(State<double>& state, double until, const RunOptions& options) {
  return counted(work(), [&] { return take_steps(state, until, options); });
}

Report EventDriven::take_steps(State<double>& state, double until, const RunOptions& options) {
  require_not_before(state, until);
  if (!options.events.empty())
    throw std::invalid_argument("run: events need one clock for all particles; " + clocks_);
  if (until == state.time) return {};
  Report report;
  if (!continues(state, until)) {
    handed_out_ = {};
    if (!begin(state, until, report)) return report;
  }
  const Observer& observer = options.observer;
  Frames frames(observer, state.time);

  double start = state.time;
  for (std::uint64_t step = 0;; ++step) {
    const double next = next_time(), end = std::min(until, next);
    const Between between(*this, start, end, next < until);
    const auto hand_out = [&] { handed_out_ = state = between.state(); };
    const bool is_due = reach() <= until;
    frames.up_to(is_due ? std::nextafter(reach(), start) : until, [&](double t) { return at(t); });
    if (end > start && observer.after_step && !observer.after_step(between)) {
      hand_out();
      return interrupted(state.time);
    }
    if (!is_due) {
      hand_out();
      if (!agrees_at(until, report)) handed_out_ = {};  // nothing to go on from
      return report;
    }
    if (step == options.max_steps) {
      hand_out();
      return step_limit(options.max_steps, state.time, advice_);
    }
    start = end;
    if (!next_event(observer, report)) {
      if (last_ > state.time) state = at_last();
      handed_out_ = {};  // nothing to go on from
      return report;
    }
  }
}

}  // namespace jetlag
