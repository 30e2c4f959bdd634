// SPDX-License-Identifier: MIT
#pragma once
// Taylor's method for first-order systems  y' = f(t, y, p),  in any number type, forwards and backwards in time.
//
//   auto lorenz = [](const auto& t, const auto& y, const auto& p) {
//     return std::array{p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]};
//   };
//   FirstOrderTaylor<> method(lorenz, 3, {.parameters = {10.0, 28.0, 8.0 / 3.0}});
//   FirstOrderState<> state{0.0, {-10.0, -1.0, 40.0}};
//   const Report report = method.run(state, 20.0);      //  state.time is 20, unless the report says why not
//
// Systems of particles have schedules (schedule/); a first-order system has one clock, so the loop is here.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/motion/first_order.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"

namespace jetlag {

template <class T = double>
struct FirstOrderState {
  T time{};
  std::vector<T> y;
  std::vector<T> rest{};  // what rounding has cut from y: y + rest is the solution. Empty: nothing
};

/// The degree at which what is left out in a step is below the rounding of T: 20 for double, 23 for 80 bits.
template <class T>
int degree_of_precision() {
  return jorba_zou_degree(static_cast<double>(std::numeric_limits<T>::epsilon()));
}

template <class T = double>
struct FirstOrderOptions {
  std::vector<T> parameters{};            // p
  int degree = degree_of_precision<T>();  // >= 2; for a tolerance: jorba_zou_degree(tolerance)
  double max_step = std::numeric_limits<double>::infinity();  // > 0

  /// What rounding cuts from y in one step is added in the next (Kahan): the rounding errors that are left are those of
  /// the increments, |h y'| in place of |y|.
  bool compensated = true;

  /// Steps of this length, > 0, in place of those of Jorba and Zou.
  std::optional<double> step{};

  /// Stops the series at a random degree with weights that keep it unbiased; `degree` is then the largest of the law.
  /// With `step` no order beyond the one drawn is computed. A sequential law sees the largest components of the terms.
  std::optional<Truncation> law{};
  Draw draws = Draw::independent;
  std::uint64_t seed = 1;
};

template <class T>
class FirstOrderTaylor;

/// What an observer sees after each step.
template <class T = double>
struct FirstOrderStepView {
  const FirstOrderTaylor<T>& integrator;  // at(t) is the solution during this step
  const FirstOrderState<T>& state;        // at the end of the step
  const T& begin;
};

template <class T = double>
struct FirstOrderRunOptions {
  std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();

  /// Called after every step; returning false ends the run as `interrupted`.
  std::function<bool(const FirstOrderStepView<T>&)> after_step{};
};

/// y(t + h) = sum_{k=0..N} y_k h^k,   h by the rule of Jorba and Zou from the largest components of the y_k.
/// Source: [JZ05] 3.   With a law:  sum_{k=0..K} w_k y_k h^k,   of mean-square order min(N, m + 1/2), weak order
/// min(N, 2m + 1).
template <class T = double>
class FirstOrderTaylor {
 public:
  /// f: see record_first_order. size: number of equations, >= 1. Throws std::invalid_argument.
  template <class F>
  FirstOrderTaylor(const F& f, int size, FirstOrderOptions<T> options = {})
      : options_(checked(std::move(options), size)),
        series_(f, size, options_.parameters, options_.degree),
        draws_(options_.draws, known_law(), options_.seed, 1),
        norms_(options_.degree + 1),
        weights_(options_.degree + 1, T(1)),
        top_(options_.degree) {}

  /// Other values of p from the next step on. Throws std::invalid_argument for another number of them.
  void set_parameters(std::vector<T> parameters) {
    series_.set_parameters(parameters);
    options_.parameters = std::move(parameters);
  }
  const FirstOrderOptions<T>& options() const { return options_; }

  /// One step towards `limit` from now, or to it where that is nearer; backwards where limit < 0. state.time is the
  /// beginning of the step and stays so: the caller keeps the time. Returns the length, negative backwards; on failure
  /// 0: the state is untouched and report.particle is the component concerned.
  T step(FirstOrderState<T>& state, const T& limit, Report& report) {
    if (!state.rest.empty() && state.rest.size() != state.y.size())
      throw std::invalid_argument("FirstOrderState: rest must be empty or as long as y");
    begin_ = state.time;
    begin_rest_ = state.rest;
    expand(state, options_.step ? 1 : options_.degree);
    if (!series_is_finite(state.time, report)) return T(0);
    const T h = proposal(limit);
    if (h == T(0) || state.time + h == state.time) {
      report = {Outcome::step_underflow,
                "step " + shown(h) + " at t = " + shown(state.time) +
                    " no longer changes the time: the solution is singular there, or the time is too large; "
                    "end before it, or count the time from a later origin",
                -1};
      return T(0);
    }
    if (options_.law || options_.step) stop_series(h, state);
    if (!series_is_finite(state.time, report)) return T(0);
    next_.resize(state.y.size());
    next_rest_.resize(state.y.size());
    for (std::size_t i = 0; i < next_.size(); ++i) {
      const T change = (state.rest.empty() ? T(0) : state.rest[i]) + increment(i, h);
      next_[i] = sum(state.y[i], change, next_rest_[i]);
      if (!finite(next_[i])) {
        report = {Outcome::non_finite,
                  "y[" + std::to_string(i) + "] after the step from t = " + shown(state.time) +
                      " is not finite: the solution has blown up; end before",
                  static_cast<int>(i)};
        return T(0);
      }
    }
    state.y.swap(next_);
    if (options_.compensated)
      state.rest.swap(next_rest_);
    else
      state.rest.clear();
    ++update_;
    ++work_.steps;
    work_.updates += series_.size();
    work_.coefficients += static_cast<std::uint64_t>(series_.order()) * series_.size();
    work_.element_coefficients += series_.order();
    work_.degrees += static_cast<std::uint64_t>(top_) * series_.size();
    return h;
  }

  /// Moves the state to time `until` exactly, forwards or backwards; the time is a compensated sum of the steps. On any
  /// outcome but success the state is the last good one. Throws std::invalid_argument for an `until` that is not
  /// finite.
  Report run(FirstOrderState<T>& state, const T& until, const FirstOrderRunOptions<T>& options = {}) {
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
      const T begin = state.time, limit = (until - begin) - lost;
      const T h = step(state, limit, report);
      if (report.outcome != Outcome::success) return report;
      state.time = h == limit ? until : sum(begin, T(h + lost), lost);
      if (options.after_step && !options.after_step({*this, state, begin}))
        return {Outcome::interrupted, "stopped at t = " + shown(state.time), -1};
    }
    return {};
  }

  /// The solution at a time of the last step, by Horner's rule; after a failure, that from where it failed.
  std::vector<T> at(const T& t) const {
    std::vector<T> y(series_.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = series_[i][0] + ((begin_rest_.empty() ? T(0) : begin_rest_[i]) + increment(i, T(t - begin_)));
    return y;
  }

  /// The series about the beginning of the last step.
  const FirstOrderExpansion<T>& series() const { return series_; }

  /// updates: equations x steps; coefficients: those beyond order 0; element_coefficients: orders of f.
  const Work& work() const { return work_; }

 private:
  static FirstOrderOptions<T> checked(FirstOrderOptions<T> options, int size) {
    if (size < 1)
      throw std::invalid_argument("FirstOrderTaylor: size must be >= 1, got " + std::to_string(size));
    if (options.law)
      options.degree = std::visit([](const auto& law) { return law.max_degree(); }, *options.law);
    if (options.degree < 2 && !options.law)
      throw std::invalid_argument("FirstOrderTaylor: degree must be >= 2, got " +
                                  std::to_string(options.degree));
    require_positive("max_step", options.max_step, true);
    if (options.step) require_positive("step", *options.step);
    return options;
  }

  static bool finite(const T& x) {
    using std::isfinite;
    return isfinite(x);
  }

  /// a + b, and what its rounding has cut.         Source: Knuth, The Art of Computer Programming 2, 4.2.2, theorem B.
  static T sum(const T& a, const T& b, T& cut) {
    const T s = a + b, of_b = s - a, of_a = s - of_b;
    cut = (a - of_a) + (b - of_b);
    return s;
  }

  const TruncationLaw* known_law() const {
    return options_.law ? std::get_if<TruncationLaw>(&*options_.law) : nullptr;
  }

  /// The degree at which the series of this step stops, the weights of its terms, and the orders that takes.
  void stop_series(const T& h, const FirstOrderState<T>& state) {
    if (const auto* law = known_law()) {
      top_ = draws_.degree(*law, shared_by_all, update_);
      for (int n = 0; n <= top_; ++n) weights_[n] = T(law->weight(n, top_));
    } else if (options_.law) {
      return roulette(std::get<SequentialLaw>(*options_.law), h, state);
    }
    grow(std::max(top_, series_.order()), state);
  }

  /// Goes on to order n while u <= P(K >= n) = p_{m+1} .. p_n.
  void roulette(const SequentialLaw& law, const T& h, const FirstOrderState<T>& state) {
    using std::abs;
    const double u = draws_.number(shared_by_all, update_);
    std::vector<double> sizes;
    double tail = 1;
    top_ = law.min_degree();
    std::fill_n(weights_.begin(), top_ + 1, T(1));
    for (int n = 1; n <= law.max_degree(); ++n) {
      grow(std::max(n - 1, series_.order()), state);
      sizes.push_back(norms_[n - 1] * std::pow(static_cast<double>(abs(h)) / unit_, n - 1));
      if (n <= law.min_degree()) continue;
      tail *= law.go_on(n, sizes, 1.0 / tail);
      if (u > tail) break;
      top_ = n;
      weights_[n] = T(1.0 / tail);
    }
    grow(std::max(top_, series_.order()), state);
  }

  /// The series from a state, in a unit of time in which its coefficients are representable: 1 until one is not.
  void expand(const FirstOrderState<T>& state, int order) {
    series_.start(state.time, state.y, T(unit_));
    grow(order, state);
  }

  void grow(int order, const FirstOrderState<T>& state) {
    for (int attempt = 0; attempt < 4; ++attempt) {
      series_.grow_to(order);
      measure();
      const double unit = better_unit();
      if (unit == unit_) return;
      unit_ = unit;
      series_.start(state.time, state.y, T(unit_));
    }
    series_.grow_to(order);
    measure();
  }

  /// norms_[k] = max_i |coefficient k of y_i|; infinite where one is not finite.
  void measure() {
    using std::abs;
    for (int k = 0; k <= series_.order(); ++k) {
      norms_[k] = 0;
      for (int i = 0; i < series_.size(); ++i) {
        const T& c = series_[i][k];
        norms_[k] = finite(c) ? std::max(norms_[k], static_cast<double>(abs(c)))
                              : std::numeric_limits<double>::infinity();
        if (std::isinf(norms_[k])) break;
      }
    }
  }

  /// The unit of the series, or where its last coefficients have over- or underflowed a power of two in which they do
  /// not: coefficients grow as (c_m / c_0)^(k/m), m the last one that is normal. A series that ends looks like one that
  /// has underflowed, but has not shrunk that fast before.
  double better_unit() const {
    const int p = series_.order();
    if (std::isnormal(std::max(norms_[p], norms_[p - 1]))) return unit_;
    int last = 0, end = 0;
    while (end <= p && std::isfinite(norms_[end])) {
      if (std::isnormal(norms_[end])) last = end;
      ++end;
    }
    const double first = std::max(norms_[0], norms_[1]);
    if (last < 2 || !std::isnormal(first)) return unit_;
    const double growth = (std::log2(norms_[last]) - std::log2(first)) / last;
    if (end <= p ? growth < 1 : growth > -16) return unit_;
    return std::clamp(std::ldexp(unit_, -static_cast<int>(std::lround(growth))), 0x1p-900, 0x1p900);
  }

  bool series_is_finite(const T& time, Report& report) const {
    for (int k = 0; k <= series_.order(); ++k)
      for (int i = 0; std::isinf(norms_[k]) && i < series_.size(); ++i)
        if (!finite(series_[i][k])) {
          report = {Outcome::non_finite,
                    "coefficient " + std::to_string(k) + " of y[" + std::to_string(i) +
                        "] is not finite at t = " + shown(time) +
                        ": f is singular there, or the solution has blown up; end before",
                    i};
          return false;
        }
    return true;
  }

  /// The step asked for or that of Jorba and Zou, signed; the limit where that is nearer or nearly reached.
  T proposal(const T& limit) const {
    using std::abs;
    const T h(options_.step
                  ? *options_.step
                  : std::min(jorba_zou_step(norms_, options_.max_step / unit_) * unit_, options_.max_step));
    if (h >= abs(limit) * T(1.0 - 1e-9)) return limit;
    return limit < T(0) ? T(-h) : h;
  }

  /// y_i(begin + h) - y_i(begin).
  T increment(std::size_t i, const T& h) const {
    const std::vector<T>& c = series_[static_cast<int>(i)];
    const T s = h / series_.time_unit();
    if (top_ == 0) return T(0);
    T horner = weights_[top_] * c[top_];
    for (int k = top_ - 1; k >= 1; --k) horner = horner * s + weights_[k] * c[k];
    return horner * s;
  }

  FirstOrderOptions<T> options_;
  FirstOrderExpansion<T> series_;
  Draws draws_;
  std::vector<double> norms_;
  std::vector<T> weights_;  // of the terms of this step, up to
  int top_;                 // its degree
  std::uint64_t update_ = 0;
  std::vector<T> next_, next_rest_, begin_rest_;
  T begin_{};
  double unit_ = 1;
  Work work_;
};

}  // namespace jetlag
