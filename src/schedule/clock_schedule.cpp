// SPDX-License-Identifier: MIT
#include "jetlag/schedule/clock_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "schedule/frames.hpp"
#include "schedule/local_motion.hpp"

namespace jetlag {

namespace {

/// The longest step: the run, or where there is a max_step as many times that as a power of two as it takes to cover
/// it.
double base_step(double max_step, double length) {
  if (!std::isfinite(max_step)) return length;
  int e;
  std::frexp(length / max_step, &e);
  return std::ldexp(max_step, std::max(e, 0));
}

/// What an observer sees of the step between two updates.
class Between final : public LastStep {
 public:
  Between(const LocalMotion& motion, Ticks::Count begin, double end)
      : motion_(motion), begin_(begin), end_(end) {}
  Piece piece() const override { return motion_.piece(begin_, end_); }
  const Work& work() const override { return motion_.work(); }

 private:
  const LocalMotion& motion_;
  Ticks::Count begin_;
  double end_;
};

bool is_finite(const State<double>& state) {
  return state.position.allFinite() && state.velocity.allFinite();
}

}  // namespace

ClockSchedule::ClockSchedule(const System<double>& system, TruncationLaw law, const ClockOptions& options)
    : motion_(std::make_unique<LocalMotion>(system, std::move(law), options)) {}
ClockSchedule::~ClockSchedule() = default;

const Work& ClockSchedule::work() const { return motion_->work(); }
std::uint64_t ClockSchedule::updates_of(int particle) const { return motion_->updates_of(particle); }

/// Ticks are countable for a thousand times the length of the run that they were made for.
bool ClockSchedule::continues(const State<double>& state, double until) const {
  const auto same = [](const Coordinates<double>& a, const Coordinates<double>& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  };
  return handed_out_.position.size() > 0 && state.time == handed_out_.time &&
         same(state.position, handed_out_.position) && same(state.velocity, handed_out_.velocity) &&
         motion_->ticks().since(0, until) < 512 * motion_->ticks().seconds(Ticks::step(0));
}

void ClockSchedule::begin(const State<double>& state, double until) {
  motion_->begin(state, Ticks(state.time, base_step(motion_->options().max_step, until - state.time)));
  begin_clocks();
}

Report ClockSchedule::run(State<double>& state, double until, const RunOptions& options) {
  if (!(until >= state.time))
    throw std::invalid_argument("run: until must not lie before the time of the state");
  if (!options.events.empty())
    throw std::invalid_argument("run: events need one clock for all particles; take Lockstep");
  if (until == state.time) return {};
  if (!continues(state, until)) begin(state, until);
  Frames frames(options, state.time);
  const Ticks& ticks = motion_->ticks();
  const auto hand_out = [&](State<double> last) { handed_out_ = state = std::move(last); };

  double end = state.time;
  for (std::uint64_t step = 0; ticks.time(due()) < until; ++step) {
    const Ticks::Count now = due();
    if (step == options.max_steps) {
      hand_out(motion_->at_tick(now));
      return {Outcome::step_limit,
              "the largest number of steps, " + std::to_string(options.max_steps) +
                  ", is used up at t = " + shown(state.time) + "; allow more or take longer steps",
              -1};
    }
    Report report;
    if (!update(report)) {
      State<double> last = motion_->at_tick(now);
      state = is_finite(last) ? std::move(last) : motion_->at(end);
      handed_out_ = {};  // nothing to go on from
      return report;
    }
    const double begin = ticks.time(now);
    if (options.on_update)
      for (int i : updated()) options.on_update({i, begin, ticks.seconds(step_of(i)), motion_->degree_of(i)});
    end = std::min(until, ticks.time(due()));
    frames.up_to(end, [&](double t) { return motion_->at(t); });
    const auto at_end = [&] { return end < until ? motion_->at_tick(due()) : motion_->at(until); };
    bool go_on = !options.go_on || options.go_on(end);
    if (options.after_step) {
      const State<double> last = at_end();
      go_on = options.after_step({Between(*motion_, now, end), last, begin}) && go_on;
    }
    if (!go_on) {
      hand_out(at_end());
      return {Outcome::interrupted, "stopped at t = " + shown(state.time), -1};
    }
  }
  frames.up_to(until, [&](double t) { return motion_->at(t); });
  hand_out(motion_->at(until));
  return {};
}

Report ClockSchedule::underflow(std::int64_t now, const std::vector<int>& particles) const {
  constexpr std::size_t most = 8;
  std::ostringstream text;
  text.precision(10);
  text << "the step at t = " << motion_->ticks().time(now) << " no longer changes the time of particle";
  for (std::size_t i = 0; i < std::min(most, particles.size()); ++i)
    text << (i == 0 ? (particles.size() > 1 ? "s " : " ") : ", ") << particles[i];
  if (particles.size() > most) text << " and " << particles.size() - most << " more";
  text << ": particles collide, a tolerance is too small or the time too large; soften the force, loosen the "
          "tolerance "
          "or count the time from a later origin";
  return {Outcome::step_underflow, text.str(), particles.front()};
}

}  // namespace jetlag
