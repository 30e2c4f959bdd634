// SPDX-License-Identifier: MIT
#include "jetlag/schedule/event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "schedule/frames.hpp"

namespace jetlag {

/// What an observer sees of the motion between two events.
class EventDriven::Between final : public LastStep {
 public:
  Between(const EventDriven& motion, double begin, double end) : motion_(motion), begin_(begin), end_(end) {}
  Piece piece() const override { return motion_.piece(begin_, end_); }
  const Work& work() const override { return motion_.work(); }

 private:
  const EventDriven& motion_;
  double begin_, end_;
};

bool EventDriven::continues(const State<double>& state) const {
  const auto same = [](const Coordinates<double>& a, const Coordinates<double>& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  };
  return handed_out_.position.size() > 0 && state.time == handed_out_.time &&
         same(state.position, handed_out_.position) && same(state.velocity, handed_out_.velocity);
}

Report EventDriven::run(State<double>& state, double until, const RunOptions& options) {
  if (!(until >= state.time))
    throw std::invalid_argument("run: until must not lie before the time of the state");
  if (!options.events.empty())
    throw std::invalid_argument("run: events need one clock for all particles; " + clocks_);
  if (until == state.time) return {};
  Report report;
  if (!continues(state)) {
    handed_out_ = {};
    if (!begin(state, report)) return report;
  }
  Frames frames(options, state.time);
  const auto hand_out = [&](double time) { handed_out_ = state = at(time); };

  double start = state.time;
  for (std::uint64_t step = 0;; ++step) {
    const double end = std::min(until, next_time());
    frames.up_to(reach() <= until ? std::nextafter(reach(), start) : until, [&](double t) { return at(t); });
    bool go_on = true;
    if (end > start) {
      if (options.after_step) go_on = options.after_step({Between(*this, start, end), at(end), start});
      if (options.go_on) go_on = options.go_on(end) && go_on;
    }
    if (!go_on) {
      hand_out(end);
      return {Outcome::interrupted, "stopped at t = " + shown(state.time), -1};
    }
    if (!(reach() <= until)) break;
    if (step == options.max_steps) {
      hand_out(end);
      return {Outcome::step_limit,
              "the largest number of steps, " + std::to_string(options.max_steps) +
                  ", is used up at t = " + shown(state.time) + "; allow more or " + advice_,
              -1};
    }
    start = end;
    if (!next_event(options, report)) {
      state = at(last_);
      handed_out_ = {};  // nothing to go on from
      return report;
    }
  }
  hand_out(until);
  return {};
}

}  // namespace jetlag
