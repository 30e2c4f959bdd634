// SPDX-License-Identifier: MIT
#include "jetlag/schedule/particle_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "jetlag/base/text.hpp"
#include "schedule/local/local_motion.hpp"

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

bool is_finite(const State<double>& state) {
  return state.position.allFinite() && state.velocity.allFinite();
}

}  // namespace

ParticleClocks::ParticleClocks(const System<double>& system, TruncationLaw law, const ClockOptions& options)
    : EventDriven("take Lockstep", "take longer steps"),
      motion_(std::make_unique<LocalMotion>(ModelAlong(system), std::move(law), options)) {}
ParticleClocks::~ParticleClocks() = default;

const Work& ParticleClocks::work() const { return motion_->work(); }
std::optional<CourantFrequency> ParticleClocks::courant_frequency() const {
  return motion_->courant_frequency();
}
std::uint64_t ParticleClocks::updates_of(int particle) const { return motion_->updates_of(particle); }

// ---- the clocks ------------------------------------------------------------------------------------------

bool ParticleClocks::begin(const State<double>& state, double until, Report&) {
  motion_->begin(state, Ticks(state.time, base_step(motion_->options().max_step, until - state.time)));
  begin_clocks();
  last_ = state.time;
  last_tick_ = 0;
  return true;
}

/// Ticks are countable for a thousand times the length of the run that they were made for.
bool ParticleClocks::reaches(double until) const {
  return motion_->ticks().since(0, until) < 512 * motion_->ticks().seconds(Ticks::step(0));
}

double ParticleClocks::next_time() const { return motion_->ticks().time(due()); }
double ParticleClocks::reach() const {
  return std::nextafter(next_time(), std::numeric_limits<double>::infinity());
}

bool ParticleClocks::next_event(const Observer& observer, Report& report) {
  const Ticks& ticks = motion_->ticks();
  const Ticks::Count now = due();
  const bool done = update(report);
  if (!done && !is_finite(motion_->at_tick(now))) return false;
  last_ = ticks.time(now);
  last_tick_ = now;
  if (done && observer.on_update)
    for (int i : updated()) observer.on_update({i, last_, ticks.seconds(step_of(i)), motion_->degree_of(i)});
  return done;
}

bool ParticleClocks::agrees_at(double until, Report& report) { return motion_->agree_at(until, report); }

// ---- the motion ------------------------------------------------------------------------------------------

State<double> ParticleClocks::at(double time) const { return motion_->at(time); }
State<double> ParticleClocks::at_next() const { return motion_->at_tick(due()); }
State<double> ParticleClocks::at_last() const { return motion_->at_tick(last_tick_); }

Piece ParticleClocks::piece(double begin, double end) const {
  return begin == last_ ? motion_->piece(last_tick_, end) : motion_->piece(begin, end);
}

Report ParticleClocks::underflow(std::int64_t now, const std::vector<int>& particles) const {
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

/// The report of a particle whose choices change again and again.
Report ParticleClocks::sliding(std::int64_t now, int particle) const {
  return {Outcome::step_underflow,
          "choices in the forces on particle " + std::to_string(particle) +
              " have changed 100 times in a row with next to no time in between, at t = " +
              shown(motion_->ticks().time(now)) +
              ": the motion slides along a jump of the force or chatters about it; end the run before",
          particle};
}

}  // namespace jetlag
