// SPDX-License-Identifier: MIT
// Whether a step of RandomTaylor ends with the forces to which its series leads.
#include <algorithm>
#include <cmath>

#include "jetlag/integrators/taylor.hpp"

namespace jetlag {

/// Whether they are those to which the series leads; always for steps that are given.
bool RandomTaylor::agrees_with_forces(const State<double>& from, double h) {
  if (ahead_ < 2) return true;
  StepDefect defect = defect_at_end(from, h);
  if (control_.is_given() && !changes_.is_to_change()) return add_to_ledger(from, defect);
  bool is_right = is_allowed(defect) || changes_.is_instant() || (h == proposed_ && agrees_but_for_kinks(h));
  // Just beyond a change they have gone another way: a little before.
  if (const double before = h * (1 - 0x1p-20);
      !is_right && changes_.is_to_change() && advances(from.time, before)) {
    sum(from, before, next_);
    defect = defect_at_end(from, before);
    sum(from, h, next_);
    is_right = is_allowed(defect) || from.time + before == from.time + h;
  }
  if (!control_.is_given()) return is_right;
  if (is_right) defect.force = 0;
  return add_to_ledger(from, defect);
}

/// Of a step that is given. A defect that is no larger than 4 times one that the terms have explained in the last 16 steps is
/// taken for explained too: norms of coefficients cost as much as sums. Always true.
bool RandomTaylor::add_to_ledger(const State<double>& from, const StepDefect& defect) {
  ledger_.begin(from.position);
  const auto who = [&] { return most_departed(defect.step); };
  bool is_right = defect.force <= 4 * explained_.force && explained_.steps < 16;
  if (is_right) {
    ++explained_.steps;
  } else {
    is_right = is_allowed(defect);
    explained_ = {is_right ? defect.force : 0.0, is_right ? ratio_of_orders(defect) : 1.0, 0};
  }
  const int degree = stops().degree();
  if (!is_right)
    ledger_.add(defect, defect.force, defect.force / defect.step, next_.position, who);
  else if (stops().law().is_fixed())
    ledger_.add(defect, left_out(defect), (degree + 2) * explained_.ratio * left_out(defect) / defect.step,
                next_.position, who);
  else
    ledger_.add(defect, 0, 0, next_.position, who);
  return true;
}

/// What a fixed degree N leaves out of the positions in a step, |x_{N+1}| h^{N+1}, as the defect tells it, 64 times: errors
/// grow faster than in a free motion where bodies pass each other (measured on a planet of e = .9).
double RandomTaylor::left_out(const StepDefect& defect) const {
  const int degree = stops().degree();
  return 64 * defect.force / (degree * (degree + 1));
}

/// |x_{N+2}| h / |x_{N+1}|, continued from the orders that are known: with it N + 2 times the error of the positions over h is what
/// is left out of velocities of their own series; of those from the derivative it is nearly 1.
double RandomTaylor::ratio_of_orders(const StepDefect& defect) const {
  const int degree = stops().degree();
  if (options_.velocity == VelocitySeries::derivative || expansion().order() <= degree) return 1.0;
  const double first = expansion().position_norm(degree - 1), last = expansion().position_norm(degree + 1);
  return first > 0 ? std::min(1.0, std::sqrt(last / first) * defect.step / expansion().time_unit()) : 1.0;
}

/// Whether they are right for all but the particles for whose kinks the step was shortened, and for these as far as it may end
/// beyond a kink, a tolerance of the path: not where the velocity changes there.
bool RandomTaylor::agrees_but_for_kinks(double h) const {
  const std::vector<int>& at_kinks = control_.at_kinks();
  if (at_kinks.empty()) return false;
  const double s = h / expansion().time_unit();
  int first = 0;
  Expansion<double>::Departure others, these;
  for (const int i : at_kinks) {
    take_departure(s, first, i, others);
    take_departure(s, i, i + 1, these);
    first = i + 1;
  }
  take_departure(s, first, expansion().particles(), others);
  const StepDefect of_these = defect_of(these, h);
  return is_allowed(defect_of(others, h)) &&
         of_these.force * control_.past_kinks() <= of_these.begun * of_these.begun / 16;
}

/// Of the state at the end, from which the next step will begin.
StepDefect RandomTaylor::defect_at_end(const State<double>& from, double h) {
  next_.time = from.time + h;
  series_.series().look_ahead(next_, ahead_);
  Expansion<double>::Departure all;
  take_departure(h / expansion().time_unit(), 0, expansion().particles(), all);
  return defect_of(all, h);
}

StepDefect RandomTaylor::defect_of(const Expansion<double>::Departure& departure, double h) const {
  const double s = h / expansion().time_unit();
  const auto motion = [&](int side) {
    return std::max(departure.velocity[side] * s, departure.acceleration[side] * s * s);
  };
  return {expansion().time(), h,         proposed_, departure.force * s * s,
          departure.position, motion(0), motion(1)};
}

/// Of the particles from first to before end, where the state ahead is the sum at s.
void RandomTaylor::take_departure(double s, int first, int end,
                                  Expansion<double>::Departure& departure) const {
  if (!known_.empty()) return take_departure_of_known(s, first, end, departure);
  if (foreseen_.at == s) return expansion().take_departure(foreseen_.accelerations, first, end, departure);
  if (stops().shared())
    return expansion().take_departure(stops().degree(), series_.weights(0), s, first, end, departure);
  for (int i = first; i < end; ++i)
    expansion().take_departure(stops().degree(i), series_.weights(i), s, i, i + 1, departure);
}

/// The particle with the largest defect.
int RandomTaylor::most_departed(double h) const {
  int most = -1;
  double largest = -1;
  for (int i = 0; i < expansion().particles(); ++i) {
    Expansion<double>::Departure own;
    take_departure(h / expansion().time_unit(), i, i + 1, own);
    if (!(own.force > largest)) continue;
    largest = own.force;
    most = i;
  }
  return most;
}

bool RandomTaylor::is_allowed(const StepDefect& defect) const {
  const double s = defect.step / expansion().time_unit();
  const auto size = [&](int n) { return expansion().position_norm(n) * std::pow(s, n); };
  const auto weight = [&](int n) {  // the largest of those that have been drawn
    double most = 1;
    for (std::size_t draw = 0; draw < stops().draws(); ++draw)
      if (n <= stops().degree(draw)) most = std::max(most, series_.weights(draw)[n]);
    return most;
  };
  return jetlag::is_allowed(defect, stops().law(), control_.is_given() ? 0.0 : control_.past_kinks(),
                            control_.is_given(), weight, expansion().order(), size);
}

}  // namespace jetlag
