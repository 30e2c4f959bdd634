// SPDX-License-Identifier: MIT
#pragma once
// Whether a step of y' = f agrees with f at its end: definitions of one_clock_taylor.hpp, which includes them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/one_clock_taylor.hpp"
#include "jetlag/integrators/short_step.hpp"

namespace jetlag {

/// Whether the end of the step agrees with f there, after halving it where it does not. False where no step does.
template <class Method, class Series, class State, class Options>
bool OneClockTaylor<Method, Series, State, Options>::agrees_with_f(const T& time, T& h) {
  using std::abs;
  const double eps = static_cast<double>(std::numeric_limits<T>::epsilon());
  const int degree = options_.degree;
  const bool singular = is_singular();
  const double allowed =
      singular ? 8 * eps : std::max(0x1p16 * eps, 16 * degree * std::exp(-2.0 * (degree - 1)));
  double unseen = 0;   // from a singular point at which nothing moves: what is nothing beside a long step
  double reached = 0;  // the size of a motion that is still that of the beginning
  const T proposed = h;
  const auto agrees = [&](const T& length) {
    if constexpr (requires { self().is_right(next_, length, proposed); })
      if (!singular) return self().is_right(next_, length, proposed);
    const auto [defect, size, begun] = self().defect(next_, length);
    if (singular && !std::isfinite(size)) return false;
    if (singular && begun == 0) {
      if (T(abs(length)) <= T(64 * eps) * T(abs(time))) return true;
      if (unseen == 0) unseen = 0x1p-80 * size;
    }
    if (defect > begun)
      reached = 0;
    else if (singular && reached == 0)
      reached = begun;
    const double bound = std::max(allowed * std::max(size, reached), unseen);
    return !(defect > bound && defect > bound + 8 * self().rounding_of_time(length));
  };
  const auto agrees_within = [&](const T& length) {
    for (const double part : looks_within_a_step) {
      const T inside = length * T(part);
      if (T(time + inside) == time) continue;
      self().sum(begin_, inside, next_);
      if (!agrees(inside)) return false;
    }
    self().sum(begin_, length, next_);
    return true;
  };
  if (changes_.is_to_change()) {  // at its end f has gone another way: a little before
    const T before = h * T(1 - 0x1p-20);
    if (changes_.is_instant() || T(time + before) == T(time + h)) return true;
    self().sum(begin_, before, next_);
    const bool right = agrees(before) && (!singular || agrees_within(before));
    if (!right) h = before;
    self().sum(begin_, h, next_);
    if (right) return true;
  }
  int halvings = 0;
  while (!agrees(h) || (singular && !agrees_within(h))) {
    ++work_.rejected;
    ++halvings;
    h = h / T(2);
    if (T(time + h) == time) return false;
    self().sum(begin_, h, next_);
  }
  held_up_ = halvings < 10 ? 0 : held_up_ + 1;
  if (held_up_ < 1000) return true;
  held_up_ = 0;
  return false;
}

/// Whether the series at the end of a step from a singular point is whole again, or the motion rests there and would come
/// back: as y = 0 of y' = -sqrt(y), and not that of y' = sqrt(y), from which it may depart at any time.
template <class Method, class Series, class State, class Options>
bool OneClockTaylor<Method, Series, State, Options>::leads_on(const T& h) {
  State end = next_;
  end.time = T(begin_.time + h);
  self().start(end, h < T(0));
  series_.grow_to(self().orders_read());
  const bool whole = self().known_orders() >= options_.degree || self().rests(begin_, end);
  self().start(begin_, h < T(0));
  series_.grow_to(self().orders_read());
  return whole;
}

/// Just beyond the change of a choice f has gone another way: a little before.
template <class Method, class Series, class State, class Options>
void OneClockTaylor<Method, Series, State, Options>::add_defect(const T& h)
  requires(Method::adds_defects)
{
  const T at = changes_.is_to_change() ? T(h * T(1 - 0x1p-20)) : h;
  if (at != h) self().sum(begin_, at, next_);
  const auto [defect, size, begun] = self().defect(next_, at);
  if (at != h) self().sum(begin_, h, next_);
  self().take_extent(begin_);
  self().take_extent(next_);
  const double beyond = defect - 64 * static_cast<double>(std::numeric_limits<T>::epsilon()) * size;
  if (!(beyond > 0) || !std::isfinite(size)) return;
  departure_ += beyond;
  if (!(beyond > largest_defect_)) return;
  largest_defect_ = beyond;
  largest_at_ = T(begin_.time + h);
}

template <class Method, class Series, class State, class Options>
std::string OneClockTaylor<Method, Series, State, Options>::warning() const {
  if constexpr (Method::adds_defects) {
    if (departure_ > 1e-3 * self().extent())
      return "the steps are given and cannot be shortened, but f at their ends contradicts the series from "
             "their "
             "beginnings, most of all at t = " +
             shown(largest_at_) + ": y may be off by " + shown(departure_) + " in an extent of " +
             shown(self().extent()) + "; take shorter steps, a higher degree or steps that are chosen";
  }
  return {};
}

}  // namespace jetlag
