// SPDX-License-Identifier: MIT
#pragma once
// Taylor's method with one clock, in any number type, forwards and backwards in time: what is the same for first-order
// systems (first_order_taylor.hpp) and for particles (particle_taylor.hpp). Its loop is here too: runs of other methods, in
// double, are schedules (schedule/).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "jetlag/base/error_free.hpp"
#include "jetlag/base/outcome.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/control/control.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/steps_to_changes.hpp"
#include "jetlag/integrators/stopped_series.hpp"

namespace jetlag {

/// The degree at which what is left out in a step is below the rounding of T: 20 for double, 23 for 80 bits.
template <class T>
int degree_of_precision() {
  return jorba_zou_degree(static_cast<double>(std::numeric_limits<T>::epsilon()));
}

/// What an observer sees after each step.
template <class Method, class State>
struct OneClockStepView {
  const Method& integrator;  // at(t) is the solution during this step
  const State& state;        // at the end of the step
  const decltype(State::time)& begin;
};

template <class View>
struct OneClockRunOptions {
  std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();

  /// Called after every step; returning false ends the run as `interrupted`.
  std::function<bool(const View&)> after_step{};
};

/// Method derives from it and says how its series starts from a state, how long a step of Jorba and Zou may be, how the
/// series is summed, and whether all that is finite. A state has a time, numbers and rests of their rounding.
///
/// y(t + h) = sum_{k=0..N} y_k h^k,   h by the rule of Jorba and Zou.         Source: [JZ05] 3.
/// With a law:  sum_{k=0..K} w_k y_k h^k,   of mean-square order min(N, m + 1/2), weak order min(N, 2m + 1).
///
/// Forces may have kinks and jumps:
///   - a step ends just beyond the first time at which a choice that was made at its beginning changes, of any length that
///     was asked for. 100 such steps in a row of next to no length, as of a motion that slides along a jump or chatters
///     about it, or 10000 that end without one before 2^-40 of what was asked for, end the run as step_underflow;
///   - where the series has no more than its first coefficients, as that of |v| v has for v = 0, the step uses these and is
///     so short that they suffice within it and at its end, if there is a whole series there or the motion rests;
///   - where f is not recorded otherwise (a root that reaches zero, the cut of atan2) it shows in the defect: y' at the end of
///     a step must be f there, for particles as in step_check.hpp, for y' = f:
///
///         h |f(t + h, y(t + h)) - y'(h)|  <=  max(2^16 eps, 16 N e^(-2(N-1))) max(|y|, h |f|),
///
///     and what 8 roundings of a late time make of f; the second is N times the last term that Jorba and Zou leave. Where it is
///     not, the step is halved; where none is short enough, or 1000 in a row had to be halved 10 times, as of an f that is all
///     rounding, the report is step_underflow. A law leaves out more than that and is not checked; nor is what no series
///     tells of the inside of a step, see forces/force.hpp. Steps of one length cannot be shortened: for y' = f `warning`
///     says where their defects add up.
template <class Method, class Series, class State, class Options>
class OneClockTaylor {
 public:
  using T = typename Series::Number;
  using StepView = OneClockStepView<Method, State>;
  using RunOptions = OneClockRunOptions<StepView>;

  const Options& options() const { return options_; }

  /// One step towards `limit` from now, or to it where that is nearer; backwards where limit < 0. state.time is the
  /// beginning of the step and stays so: the caller keeps the time. Returns the length, negative backwards; on failure
  /// 0: the state is untouched and report.particle is the component or particle concerned.
  T step(State& state, const T& limit, Report& report);

  /// Moves the state to time `until` exactly, forwards or backwards; the time is a compensated sum of the steps. On any
  /// outcome but success the state is the last good one. Throws std::invalid_argument for an `until` that is not finite.
  Report run(State& state, const T& until, const RunOptions& options = {});

  /// The series about the beginning of the last step.
  const Series& series() const { return series_.series(); }

  const Work& work() const { return work_; }

  /// Of y' = f: where the defects of steps of one length, but for 64 roundings of y, add up to more than a
  /// thousandth of the extent of the solution so far, that they do, and when they were largest. Empty otherwise.
  std::string warning() const;

 protected:
  /// beyond: see StoppedSeries. Throws std::invalid_argument for options that are out of range.
  OneClockTaylor(const std::string& name, Options options, Series series, int beyond);

  /// The degree of the options; the largest one of a law, where there is one.
  static int degree_of(const Options& options) { return law_of(options).max_degree(); }

  /// At a time of the last step; after a failure, of the series from where it failed.
  State state_at(const T& t) const {
    State state;
    self().sum(begin_, T(t - begin_.time), state);
    state.time = t;
    return state;
  }

  static bool finite(const T& x) {
    using std::isfinite;
    return isfinite(x);
  }

  /// The last term of the sums of a step.
  int top() const { return std::min(series_.top(), known_); }
  /// Whether the series of the step has no more than its first coefficients.
  bool is_singular() const { return known_ < series_.top(); }

  Options options_;
  StoppedSeries<Series> series_;
  Work work_;
  State begin_;  // of the last step

 private:
  const Method& self() const { return static_cast<const Method&>(*this); }
  Method& self() { return static_cast<Method&>(*this); }

  Report take_steps(State& state, const T& until, const RunOptions& options);
  static Options checked(const std::string& name, Options options);
  static Truncation truncation_of(const Options& options) {
    return options.law ? *options.law : Truncation(fixed_degree(std::max(options.degree, 1)));
  }
  static TruncationLaw law_of(const Options& options) { return known_beforehand(truncation_of(options)); }

  T proposal(const T& limit) const;
  T length(const T& limit);
  T up_to_change(const T& h);
  bool agrees_with_f(const T& time, T& h);
  bool leads_on(const T& h);
  void add_defect(const T& h)
    requires(Method::adds_defects);
  Report refusal(const T& time, const T& h, bool contradicted) const;
  Report underflow(const T& time, const T& h) const;

  State next_;  // room for the end of a step
  std::uint64_t update_ = 0;
  int known_ = std::numeric_limits<int>::max();  // the orders of the series that exist
  StepsToChanges<T> changes_;
  int held_up_ = 0;                            // steps in a row that were halved 10 times
  double departure_ = 0, largest_defect_ = 0;  // of steps that are given
  T largest_at_{};
};

// ---- definitions -----------------------------------------------------------------------------------------

template <class Method, class Series, class State, class Options>
OneClockTaylor<Method, Series, State, Options>::OneClockTaylor(const std::string& name, Options options,
                                                               Series series, int beyond)
    : options_(checked(name, std::move(options))),
      series_(std::move(series), Stops(truncation_of(options_), options_.draws, options_.seed), beyond) {}

template <class Method, class Series, class State, class Options>
Options OneClockTaylor<Method, Series, State, Options>::checked(const std::string& name, Options options) {
  if (options.degree < 2 && !options.law)
    throw std::invalid_argument(name + ": degree must be >= 2, got " + std::to_string(options.degree));
  options.degree = degree_of(options);
  require_positive("max_step", options.max_step, true);
  if (options.step) require_positive("step", *options.step);
  return options;
}

template <class Method, class Series, class State, class Options>
auto OneClockTaylor<Method, Series, State, Options>::step(State& state, const T& limit, Report& report) -> T {
  begin_ = state;
  self().start(state, limit < T(0));
  series_.draw(update_);
  if (!options_.step) series_.grow_to(self().orders_read());
  T h = length(limit);
  if (h == T(0) || T(state.time + h) == state.time) {
    if (self().series_is_finite(report)) report = refusal(state.time, h, false);
    return T(0);
  }
  series_.stop(h, update_);
  self().sum(state, h, next_);
  const bool singular = is_singular(), checked = !options_.law;
  if ((singular || (checked && !options_.step)) && !agrees_with_f(state.time, h)) {
    if (self().series_is_finite(report)) report = refusal(state.time, h, true);
    return T(0);
  }
  if constexpr (Method::adds_defects)
    if (checked && options_.step && !singular) add_defect(h);
  if (singular && !leads_on(h)) {
    self().series_is_finite(report);
    return T(0);
  }
  if (!self().is_finite(next_, report)) {
    Report of_series;
    if (!self().series_is_finite(of_series)) report = of_series;
    return T(0);
  }
  if (changes_.is_stuck()) {
    report = refusal(state.time, h, false);
    changes_ = {};
    return T(0);
  }
  next_.time = state.time;
  if (!options_.compensated) next_.drop_rests();
  std::swap(state, next_);
  ++update_;
  ++work_.steps;
  self().count();
  return h;
}

/// The step to try: `proposal` up to the first change of a condition, or where the series has no more than its first
/// coefficients, a time in which the motion changes.
template <class Method, class Series, class State, class Options>
auto OneClockTaylor<Method, Series, State, Options>::length(const T& limit) -> T {
  using std::abs;
  known_ = std::numeric_limits<int>::max();
  if (options_.step && (!options_.law || self().has_conditions())) series_.grow_to(self().orders_read());
  const int known = options_.law ? 0 : self().known_orders();
  if (known < 1 || known >= std::min(series().order(), series_.stops().degree()))
    return up_to_change(proposal(limit));
  known_ = known;
  const double scale = self().scale(), longest = options_.step.value_or(options_.max_step);
  T most = abs(limit);
  if (scale > 0 && scale < static_cast<double>(most)) most = T(scale);
  if (longest < static_cast<double>(most)) most = T(longest);
  return up_to_change(limit < T(0) ? T(-most) : most);
}

/// The step h, or what leads just beyond the first change of a condition: far enough that the next step sees it, which may
/// take some places of the time and of y, more where that was not enough before.
template <class Method, class Series, class State, class Options>
auto OneClockTaylor<Method, Series, State, Options>::up_to_change(const T& h) -> T {
  using std::abs;
  if (h == T(0) || !finite(h) || !self().has_conditions()) {
    changes_.take_none();
    return h;
  }
  const T unit = abs(series().time_unit());
  T reach = T(abs(h) / unit);
  const T most = reach;
  std::optional<T> change = self().first_change(reach, is_singular());
  if (change) change = T(*change * unit);
  const T step = changes_.step(T(abs(h)), reach < most ? T(reach * unit) : abs(h), series().time(), change);
  return h < T(0) ? T(-step) : step;
}

template <class Method, class Series, class State, class Options>
Report OneClockTaylor<Method, Series, State, Options>::refusal(const T& time, const T& h,
                                                               bool contradicted) const {
  if (contradicted)
    return {Outcome::step_underflow,
            "f at the end of a step contradicts the series from its beginning at t = " + shown(time) +
                ", however short the step: f is singular or jumps there; end before, or write f with select, "
                "abs, "
                "min or max, which are watched",
            -1};
  if (changes_.is_stuck()) return {Outcome::step_underflow, changes_.cause("f", shown(time)), -1};
  return underflow(time, h);
}

template <class Method, class Series, class State, class Options>
Report OneClockTaylor<Method, Series, State, Options>::run(State& state, const T& until,
                                                           const RunOptions& options) {
  return counted(work_, [&] { return take_steps(state, until, options); });
}

template <class Method, class Series, class State, class Options>
Report OneClockTaylor<Method, Series, State, Options>::take_steps(State& state, const T& until,
                                                                  const RunOptions& options) {
  if (!finite(until) || !finite(state.time))
    throw std::invalid_argument("run: until and the time of the state must be finite");
  T lost(0);  // what rounding has cut from state.time
  for (std::uint64_t n = 0; state.time != until; ++n) {
    if (n >= options.max_steps)
      return {Outcome::step_limit,
              "the largest number of steps, " + std::to_string(options.max_steps) +
                  ", is used up at t = " + shown(state.time) + "; allow more",
              -1};
    Report report;
    const T begin = state.time, limit = T(until - begin) - lost;
    const T h = step(state, limit, report);
    if (report.outcome != Outcome::success) return report;
    const TwoPart<T> sum = two_sum(begin, T(h + lost));
    state.time = h == limit ? until : sum.high;
    lost = sum.low;
    if (options.after_step && !options.after_step({self(), state, begin}))
      return {Outcome::interrupted, "stopped at t = " + shown(state.time), -1};
  }
  return {};
}

/// The step asked for or that of Jorba and Zou, signed; the limit where that is nearer or nearly reached.
template <class Method, class Series, class State, class Options>
auto OneClockTaylor<Method, Series, State, Options>::proposal(const T& limit) const -> T {
  using std::abs;
  const auto chosen = [&] {
    const double unit = std::abs(static_cast<double>(series().time_unit()));
    return std::min(self().jorba_zou(options_.max_step / unit) * unit, options_.max_step);
  };
  const T h(options_.step ? *options_.step : chosen());
  if (h >= T(abs(limit) * T(1.0 - 1e-9))) return limit;
  return limit < T(0) ? T(-h) : h;
}

template <class Method, class Series, class State, class Options>
Report OneClockTaylor<Method, Series, State, Options>::underflow(const T& time, const T& h) const {
  return {Outcome::step_underflow,
          "step " + shown(h) + " at t = " + shown(time) +
              " no longer changes the time: the solution is singular there, or the time is too large; "
              "end before it, or count the time from a later origin",
          -1};
}

}  // namespace jetlag

#include "jetlag/integrators/one_clock_checks.hpp"
