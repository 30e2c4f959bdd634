// SPDX-License-Identifier: MIT
#include "jetlag/schedule/lockstep.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/model/finite.hpp"
#include "schedule/event_watch.hpp"
#include "schedule/observing.hpp"

namespace jetlag {

namespace {

/// The highest order whose coefficient of a particle is not zero.
int degree_of(const PieceView& piece, int particle) {
  int k = static_cast<int>(piece.position.size()) - 1;
  while (k > 0 && piece.position[k].row(particle).isZero(0.0)) --k;
  return k;
}

/// The state at the beginning of a step, rests of compensated sums dropped.
State<double> beginning(const PieceView& piece) {
  return {piece.begin, piece.position.front(), piece.velocity.front()};
}

void tell_updates(const PieceView& piece, double step, const std::function<void(const Update&)>& on_update) {
  for (int i = 0; i < piece.position.front().rows(); ++i)
    on_update({i, piece.begin, step, degree_of(piece, i)});
}

/// What an observer sees of the last step of an integrator.
class LastStep final : public StepView {
 public:
  LastStep(const Integrator& integrator, double begin, const State<double>& state)
      : StepView(begin, state.time), integrator_(integrator), state_(state) {}
  const State<double>& state() const override { return state_; }
  Piece piece() const override { return integrator_.piece(); }
  PieceView motion() const override { return integrator_.motion(); }
  const Work& work() const override { return integrator_.work(); }

 private:
  const Integrator& integrator_;
  const State<double>& state_;
};

}  // namespace

Report Lockstep::run(State<double>& state, double until, const RunOptions& options) {
  return counted(work(), [&] { return take_steps(state, until, options); });
}

Report Lockstep::take_steps(State<double>& state, double until, const RunOptions& options) {
  require_not_before(state, until);
  EventWatch events(options, state);
  const Observer& observer = options.observer;
  Frames frames(observer, state.time);
  double lost = 0;  // what rounding has cut from state.time
  const double start = state.time;
  const bool seeking = std::isinf(until) && std::ranges::any_of(options.events, &Event::terminal);
  if (std::isinf(until) && !seeking && options.max_steps == RunOptions{}.max_steps && !observer.after_step)
    throw std::invalid_argument(
        "run: until may be infinite where a terminal event, max_steps or after_step ends the run");
  for (std::uint64_t step = 0; state.time < until; ++step) {
    if (step >= options.max_steps) return step_limit(options.max_steps, state.time);
    Report report;
    // On the way to an event at an unknown time a step is no longer than the way so far: that of free fall has no end.
    const double begin = state.time, lost_before = lost,
                 limit = seeking ? std::max({1.0, begin - start, 0x1p-32 * std::abs(begin)})
                                 : (until - begin) - lost;
    if (seeking && !std::isfinite(begin + limit))
      return {Outcome::non_finite,
              "no terminal event has come up to t = " + shown(begin) + "; end the run before", -1};
    const double h = integrator_->step(state, limit, report);
    if (report.outcome != Outcome::success) return report;
    if (std::isfinite(options.largest) && !in_range(state, options.largest, begin, report)) {
      state = beginning(integrator_->motion());
      return report;
    }
    if (h == limit && !std::isinf(until)) {
      state.time = until;
    } else {
      const double length = h + lost;
      state.time = begin + length;
      lost = length - (state.time - begin);
    }
    if (!events.idle()) {
      const double end = state.time;
      PieceView piece = integrator_->motion();
      piece.end = end;
      report = events.look(piece, state);
      if (report.outcome != Outcome::success && report.outcome != Outcome::event) return report;
      if (state.time != end) lost = lost_before;  // the step ends at an event, by the clock of its beginning
    }
    if (observer.on_update) tell_updates(integrator_->motion(), state.time - begin, observer.on_update);
    if (frames.wants(state.time)) frames.up_to(state, integrator_->motion());
    const bool go_on = !observer.after_step || observer.after_step(LastStep(*integrator_, begin, state));
    if (report.outcome == Outcome::event) return report;
    if (!go_on) return interrupted(state.time);
  }
  return {};
}

}  // namespace jetlag
