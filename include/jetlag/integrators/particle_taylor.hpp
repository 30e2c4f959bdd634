// SPDX-License-Identifier: MIT
#pragma once
// Taylor's method for systems of particles in any number type, forwards and backwards in time.
//
//   using Digits50 = boost::multiprecision::cpp_bin_float_50;
//   System<Digits50> system(2, {1, 1});
//   system.add<Gravity>({{0, 1}}, {{1}});
//   ParticleTaylor<Digits50> method(system);
//   const Report report = method.run(state, until);      //  state.time is `until`, unless the report says why not
//
// In double there is more to choose: integrators/taylor.hpp with a control and a schedule. The series and its draws are the
// same. Kinks of forces (control/to_kinks.hpp) are not looked for: a step over one is taken again, shorter, where the force at
// its end is not that to which the series leads.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/one_clock_taylor.hpp"
#include "jetlag/integrators/rest.hpp"
#include "jetlag/integrators/step_check.hpp"
#include "jetlag/model/finite.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"

namespace jetlag {

/// As FirstOrderOptions; a law has one draw for all particles, and the velocities their own series.
template <class T = double>
struct ParticleTaylorOptions {
  int degree = degree_of_precision<T>();
  double max_step = std::numeric_limits<double>::infinity();  // [s]
  bool compensated = true;
  std::optional<double> step{};  // [s]
  std::optional<Truncation> law{};
  Draw draws = Draw::independent;
  std::uint64_t seed = 1;
};

template <class T>
class ParticleTaylor;
template <class T>
using ParticleTaylorBase =
    OneClockTaylor<ParticleTaylor<T>, Expansion<T>, State<T>, ParticleTaylorOptions<T>>;

/// The step is that of JorbaZou. A step is a choice, not a result: it is
/// made in doubles; the time and all that is summed are of type T.
template <class T = double>
class ParticleTaylor : public ParticleTaylorBase<T> {
  using Base = ParticleTaylorBase<T>;
  friend Base;

 public:
  /// Keeps no reference to the system. Throws std::invalid_argument for options that are out of range.
  explicit ParticleTaylor(const System<T>& system, ParticleTaylorOptions<T> options = {});

  /// The state at a time of the last step, by Horner's rule; after a failure, of the series from where it failed.
  State<T> at(const T& t) const { return this->state_at(t); }

 private:
  using Base::finite;
  using Base::series;

  static constexpr bool adds_defects = false;

  void start(const State<T>& state, bool backwards) {
    this->series_.lead_backwards(backwards);
    this->series_.start(state);
  }
  bool has_conditions() const { return series().has_conditions(); }
  std::optional<T> first_change(T& h, bool of_known) {
    return this->series_.series().first_change(h, of_known);
  }
  int known_orders() const;
  double scale() const { return 0; }  // from a singular point the longest step is tried first
  struct Defect {
    double defect, size, begun;
  };
  Defect defect(const State<T>& end, const T& h);
  bool is_right(const State<T>& end, const T& h, const T& proposed);
  typename Expansion<T>::Departure departure_at(const State<T>& end, const T& h);
  double rounding_of_time(const T&) const { return 0; }  // forces of a late time are those of the end
  bool rests(const State<T>& begin, const State<T>& end);
  bool is_at_rest(const State<T>& state) const;
  int orders_read() const { return this->options_.degree + 1; }
  double jorba_zou(double max_step) const {
    return jorba_zou_step_of(series(), this->options_.degree, max_step);
  }
  void sum(const State<T>& from, const T& h, State<T>& to) const;
  bool series_is_finite(Report& report) const;
  bool is_finite(const State<T>& end, Report& report) const;
  int first_not_finite(const Coordinates<T>& rows) const;
  void count();

  std::uint64_t moving_ = 0;
  std::vector<bool> fixed_;
};

// ---- definitions -----------------------------------------------------------------------------------------

template <class T>
ParticleTaylor<T>::ParticleTaylor(const System<T>& system, ParticleTaylorOptions<T> options)
    : Base("ParticleTaylor", options, Expansion<T>(system, Base::degree_of(options) + 1), 1) {
  fixed_ = system.fixed();
  for (const bool fixed : fixed_) moving_ += fixed ? 0 : 1;
}

/// The orders from 0 on that are finite, of positions and velocities: of the positions one more. All, where the last one is.
template <class T>
int ParticleTaylor<T>::known_orders() const {
  if (finite(series().norm(series().order()))) return series().order() - 1;
  int k = 0;
  while (k <= series().order() && finite(series().norm(k))) ++k;
  return k - 2;
}

/// Of the forces at the end of a step, from which the next one will begin.
template <class T>
typename Expansion<T>::Departure ParticleTaylor<T>::departure_at(const State<T>& end, const T& h) {
  State<T> there = end;
  there.time = T(series().time() + h);
  if (!this->options_.compensated) there.drop_rests();
  const int top = this->is_singular() ? this->top() + 1 : this->top();
  this->series_.series().forget_ahead();
  this->series_.series().look_ahead(there, this->is_singular() ? 2 : std::min(3, orders_read()));
  typename Expansion<T>::Departure departure;
  series().take_departure(top, this->series_.weights(), T(h / series().time_unit()), 0, series().particles(),
                          departure);
  return departure;
}

/// Whether the forces at the end of a step that is chosen are those to which its series leads (step_check.hpp).
template <class T>
bool ParticleTaylor<T>::is_right(const State<T>& end, const T& h, const T& proposed) {
  using std::abs;
  const auto d = departure_at(end, h);
  const T s = T(h / series().time_unit());
  const auto metres = [&](const T& velocity, const T& acceleration) {
    return static_cast<double>(std::max(T(s * velocity), T(s * s * acceleration)));
  };
  const StepDefect defect{static_cast<double>(series().time()),    static_cast<double>(T(abs(h))),
                          static_cast<double>(T(abs(proposed))),   static_cast<double>(T(s * s * d.force)),
                          static_cast<double>(d.position),         metres(d.velocity[0], d.acceleration[0]),
                          metres(d.velocity[1], d.acceleration[1])};
  const auto size = [&](int n) {
    return static_cast<double>(series().position_norm(n)) * std::pow(static_cast<double>(s), n);
  };
  return is_allowed(
      defect, this->series_.stops().law(), 0, false, [](int) { return 1.0; }, series().order(), size);
}

/// From a singular point: how far velocities lead astray, h |a - x''| at the end, and their size max(|v|, h |a|) at both ends
/// and at the beginning. All are largest components, in m/s; 0 of infinity where the force at the end is not finite.
template <class T>
typename ParticleTaylor<T>::Defect ParticleTaylor<T>::defect(const State<T>& end, const T& h) {
  using std::abs;
  const T s = T(h / series().time_unit());
  const auto d = departure_at(end, h);
  const T unit = abs(series().time_unit());
  const auto speed = [&](int side) {
    return static_cast<double>(T(std::max(d.velocity[side], T(s * d.acceleration[side])) / unit));
  };
  if (!finite(d.force)) return {0, std::numeric_limits<double>::infinity(), 0};
  return {static_cast<double>(T(s * d.force / unit)), std::max(speed(0), speed(1)), speed(0)};
}

/// Whether no particle moves nor is pushed at the start of the series, that of the state.
template <class T>
bool ParticleTaylor<T>::is_at_rest(const State<T>& state) const {
  return (state.velocity.array() == T(0)).all() && series().velocity_norm(1) == T(0);
}

/// Whether the motion rests at both ends of a step, of which the series has been started at the end, and stays there.
template <class T>
bool ParticleTaylor<T>::rests(const State<T>& begin, const State<T>& end) {
  const auto start = [&](const State<T>& state) {
    this->series_.start(state);
    this->series_.grow_to(2);
  };
  if (!is_at_rest(end)) return false;
  start(begin);
  if (!is_at_rest(begin)) return false;
  std::vector<bool> resting;
  for (const bool fixed : fixed_) resting.push_back(!fixed);
  const auto accelerations = [&](const State<T>& state) {
    start(state);
    return series().velocity(1);
  };
  return that_stay(begin, resting, accelerations) == resting;
}

/// x + (rest of x + h (rest of v) + sum_{n>=1} w_n x_n h^n),   v + (rest of v + sum_{n>=1} w_n v_n h^n), and new rests.
template <class T>
void ParticleTaylor<T>::sum(const State<T>& from, const T& h, State<T>& to) const {
  const T s = h / series().time_unit();
  const T* w = this->series_.weights();
  const int top = this->top(), top_of_positions = this->is_singular() ? top + 1 : top;
  const auto rest = [](const Coordinates<T>& rests, Eigen::Index i) {
    return rests.size() == 0 ? T(0) : rests.data()[i];
  };
  const auto add = [&](const Coordinates<T>& y, const auto& rest_of, Coordinates<T>& end,
                       Coordinates<T>& cut) {
    cut.resizeLike(y);
    for (Eigen::Index i = 0; i < y.size(); ++i) {  // `end` holds the sums from order 1 on, over s
      const T change = rest_of(i) + T(s * end.data()[i]);
      const TwoPart<T> next = two_sum(y.data()[i], change);
      end.data()[i] = next.high;
      cut.data()[i] = next.low;
    }
  };
  series().position_sum(1, top_of_positions, w, s, to.position);
  add(
      from.position,
      [&](Eigen::Index i) { return T(rest(from.position_rest, i) + T(h * rest(from.velocity_rest, i))); },
      to.position, to.position_rest);
  series().velocity_sum(1, top, w, s, to.velocity);
  add(
      from.velocity, [&](Eigen::Index i) { return rest(from.velocity_rest, i); }, to.velocity,
      to.velocity_rest);
}

template <class T>
int ParticleTaylor<T>::first_not_finite(const Coordinates<T>& rows) const {
  for (Eigen::Index i = 0; i < rows.size(); ++i)
    if (!finite(rows.data()[i])) return static_cast<int>(i / rows.cols());
  return -1;
}

template <class T>
bool ParticleTaylor<T>::series_is_finite(Report& report) const {
  for (int k = 0; k <= series().order(); ++k) {
    const int bad = first_not_finite(series().position(k));
    if (bad < 0) continue;
    report = {Outcome::non_finite,
              "coefficient " + std::to_string(k) + " of the motion of particle " + std::to_string(bad) +
                  " is not finite at t = " + shown(series().time()) + ": " + cause_of_no_coefficient(k) +
                  ", or the motion has blown up; end before",
              bad};
    return false;
  }
  return true;
}

template <class T>
bool ParticleTaylor<T>::is_finite(const State<T>& end, Report& report) const {
  const int bad = std::max(first_not_finite(end.position), first_not_finite(end.velocity));
  if (bad < 0) return true;
  report = {Outcome::non_finite,
            "particle " + std::to_string(bad) + " after the step from t = " + shown(series().time()) +
                " is not finite: the motion has blown up; end before",
            bad};
  return false;
}

template <class T>
void ParticleTaylor<T>::count() {
  this->work_.updates += moving_;
  this->work_.coefficients += static_cast<std::uint64_t>(series().order() - 1) * moving_;
  this->work_.element_coefficients = series().element_coefficients();
  this->work_.degrees += static_cast<std::uint64_t>(this->series_.stops().degree()) * moving_;
}

extern template class OneClockTaylor<ParticleTaylor<double>, Expansion<double>, State<double>,
                                     ParticleTaylorOptions<double>>;
extern template class ParticleTaylor<double>;

}  // namespace jetlag
