// SPDX-License-Identifier: MIT
// Steps of RandomTaylor from singular points.
#include "jetlag/integrators/short_step.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/rest.hpp"
#include "jetlag/integrators/taylor.hpp"

namespace jetlag {

namespace {

/// The highest order up to which the coefficients of a particle are finite.
int known_order(const Expansion<double>& series, int particle) {
  int k = 0;
  while (k <= series.order() && series.position(k).row(particle).allFinite()) ++k;
  return k - 1;
}

Report no_series_beyond(double time, int particle) {
  return {
      Outcome::non_finite,
      "the force on particle " + std::to_string(particle) + " has no series at t = " + shown(time) +
          ", nor just after (a norm or root of what is zero?): the motion may go on in more than one way, or "
          "it stays at a singular point; start beside it, or write the force so that it is smooth there",
      particle};
}

Report never_short_enough(double time, int particle) {
  return {
      Outcome::step_underflow,
      "the force on particle " + std::to_string(particle) + " has no series at t = " + shown(time) +
          " (a norm or root of what is zero?), and no step is short enough to do without; start beside it, "
          "or write the force so that it is smooth there",
      particle};
}

}  // namespace

/// A step of at most `limit`, and the longest one of the control, where there is no whole series, but the first coefficients of
/// all particles. Returns 0 with the report as it was where there are not, or where the law may not be left.
double RandomTaylor::short_step(State<double>& state, double limit, const StepsToChanges<double>& changes,
                                Report& report) {
  const TruncationLaw& law = stops().law();
  if (!law.is_fixed() && control_.orders_read(law, options_.velocity) < 3) return 0.0;
  if (!along_.none() || !find_known()) return 0.0;
  const auto fail = [&](const Report& why) {
    known_.clear();
    report = why;
    return 0.0;
  };
  const double most = std::min(limit, control_.longest());
  changes_ = changes;
  double h = up_to_change(std::isfinite(most) ? most : std::max(1.0, std::abs(state.time)));
  if (is_stuck(state.time, report)) return fail(report);
  if (!advances(state.time, h)) return fail(never_short_enough(state.time, least_known()));
  proposed_ = h;
  for (ShortStepBound bound; !agrees_all_along(state, h, bound);) {
    ++work_.rejected;
    changes_.shorten();
    h *= 0.5;
    if (!advances(state.time, h)) return fail(never_short_enough(state.time, least_known()));
  }
  if (const int stopped = first_stopped(state, h); stopped >= 0)
    return fail(no_series_beyond(state.time, stopped));
  report = {};
  return accept(state, h);
}

/// The orders that each particle has. Returns whether all have 2 at least, and some not all.
bool RandomTaylor::find_known() {
  series_.grow_to(stops().law().max_degree() + 1);
  known_.clear();
  for (int i = 0; i < expansion().particles(); ++i) known_.push_back(known_order(expansion(), i));
  const int least = known_.empty() ? 0 : known_[least_known()];
  if (least >= 2 && least < expansion().order()) return true;
  known_.clear();
  return false;
}

/// A particle of which the fewest orders are known.
int RandomTaylor::least_known() const {
  return static_cast<int>(std::ranges::min_element(known_) - known_.begin());
}

/// Whether the forces are those to which the series leads, at the end of the step and within it. The state at the end stays in
/// next_.
bool RandomTaylor::agrees_all_along(const State<double>& from, double h, ShortStepBound& bound) {
  // Just beyond a change of a choice forces have gone another way: a little before.
  const double before = h * (1 - 0x1p-20);
  const double last = changes_.is_to_change() && advances(from.time, before) ? before : h;
  if (!agrees_at(from, last, bound)) return false;
  for (const double part : looks_within_a_step)
    if (advances(from.time, part * last) && !agrees_at(from, part * last, bound)) return false;
  sum(from, h, next_);
  return next_.position.allFinite() && next_.velocity.allFinite();
}

bool RandomTaylor::agrees_at(const State<double>& from, double h, ShortStepBound& bound) {
  sum(from, h, next_);
  if (!next_.position.allFinite() || !next_.velocity.allFinite()) return false;
  return bound.allows(defect_at_end(from, h));
}

// ---- where it leads ------------------------------------------------------------------------------------------

/// The first particle that has no whole series at the end of the step, unless it stays at rest up to there; -1 if there is none.
int RandomTaylor::first_stopped(const State<double>& from, double h) {
  const int order = expansion().order();
  State<double> end = next_;
  end.time = from.time + h;
  std::vector<bool> rested = resting(from.velocity), stopped;
  const auto start = [&](const State<double>& state, int up_to) {
    series_.start(state);
    series_.grow_to(up_to);
  };
  start(end, order);
  const std::vector<bool> rests = resting(end.velocity);
  for (int i = 0; i < expansion().particles(); ++i) {
    stopped.push_back(!fixed_[i] && known_order(expansion(), i) < order);
    const bool is_pushed_then = changes_.is_to_change() && end.velocity.row(i).isZero(0.0);
    rested[i] = rested[i] && (rests[i] || is_pushed_then) && stopped[i] && !control_.seeks_kinks();
  }
  const std::vector<bool> stay = that_stay(from, rested, [&](const State<double>& beside) {
    start(beside, 2);
    return expansion().position(2);
  });
  start(from, order);
  for (int i = 0; i < expansion().particles(); ++i)
    if (stopped[i] && !stay[i]) return i;
  return -1;
}

/// Which particles neither move nor are pushed at the start of the series.
std::vector<bool> RandomTaylor::resting(const Coordinates<double>& velocity) const {
  std::vector<bool> rests;
  for (int i = 0; i < expansion().particles(); ++i)
    rests.push_back(velocity.row(i).isZero(0.0) && expansion().position(2).row(i).isZero(0.0));
  return rests;
}

// ---- sums of what is known -----------------------------------------------------------------------------------

/// sum_{n>=first} c_n s^(n-first) of the orders that each particle has; of velocities one less.
void RandomTaylor::sum_of_known(bool of_velocity, double s, int first, Coordinates<double>& sum) const {
  const int less = of_velocity ? 1 : 0;
  sum.setZero(expansion().particles(), expansion().dimension());
  for (int i = 0; i < expansion().particles(); ++i)
    for (int n = known_[i] - less; n >= first; --n)
      sum.row(i) = sum.row(i) * s + (of_velocity ? expansion().velocity(n) : expansion().position(n)).row(i);
}

void RandomTaylor::take_departure_of_known(double s, int first, int end,
                                           Expansion<double>::Departure& departure) const {
  const std::vector<double> ones(expansion().order() + 1, 1.0);
  for (int i = first; i < end; ++i)
    expansion().take_departure(known_[i], ones.data(), s, i, i + 1, departure);
}

Piece RandomTaylor::piece_of_known() const {
  Piece piece{expansion().time(), expansion().time() + last_step_, {}, {}, expansion().time_unit()};
  const auto known = [&](Coordinates<double> c, int n) {
    for (int i = 0; i < expansion().particles(); ++i)
      if (n > known_[i]) c.row(i).setZero();
    return c;
  };
  for (int n = 0; n <= expansion().order(); ++n) {
    piece.position.push_back(known(expansion().position(n), n));
    if (n < expansion().order()) piece.velocity.push_back(known(expansion().velocity(n), n + 1));
  }
  return piece;
}

}  // namespace jetlag
