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
// f may have kinks and jumps: see one_clock_taylor.hpp. With events, stop times and dense output of a whole run:
// first_order_integrator.hpp.

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/base/text.hpp"
#include "jetlag/integrators/one_clock_taylor.hpp"
#include "jetlag/motion/first_order.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"

namespace jetlag {

template <class T = double>
struct FirstOrderState {
  T time{};
  std::vector<T> y;
  std::vector<T> rest{};  // what rounding has cut from y: y + rest is the solution. Empty: nothing

  void drop_rests() { rest.clear(); }
};

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
template <class T>
using FirstOrderBase =
    OneClockTaylor<FirstOrderTaylor<T>, FirstOrderExpansion<T>, FirstOrderState<T>, FirstOrderOptions<T>>;

template <class T = double>
using FirstOrderStepView = OneClockStepView<FirstOrderTaylor<T>, FirstOrderState<T>>;
template <class T = double>
using FirstOrderRunOptions = OneClockRunOptions<FirstOrderStepView<T>>;

/// The step is that of the largest components of the y_k. In Work, updates are equations x steps, coefficients those beyond
/// order 0, element_coefficients orders of f.
template <class T = double>
class FirstOrderTaylor : public FirstOrderBase<T> {
  using Base = FirstOrderBase<T>;
  friend Base;

 public:
  /// f: see record_first_order. size: number of equations, >= 1. Throws std::invalid_argument.
  template <class F>
  FirstOrderTaylor(const F& f, int size, FirstOrderOptions<T> options = {})
      : Base("FirstOrderTaylor", options,
             FirstOrderExpansion<T>(f, checked(size), options.parameters, Base::degree_of(options)), 0) {}

  using Base::series;

  /// Other values of p from the next step on. Throws std::invalid_argument for another number of them.
  void set_parameters(std::vector<T> parameters);

  /// The solution at a time of the last step, by Horner's rule; after a failure, that from where it failed.
  std::vector<T> at(const T& t) const { return this->state_at(t).y; }
  /// The same as polynomials in (t - begin) / series().time_unit(): shape (equations)(orders).
  std::vector<std::vector<T>> polynomials() const;

 private:
  using Base::finite;

  static int checked(int size) {
    if (size < 1)
      throw std::invalid_argument("FirstOrderTaylor: size must be >= 1, got " + std::to_string(size));
    return size;
  }

  static constexpr bool adds_defects = true;

  void start(const FirstOrderState<T>& state, bool backwards);
  bool has_conditions() const { return series().has_conditions(); }
  std::optional<T> first_change(T& h, bool of_known) {
    return this->series_.series().first_change(h, of_known);
  }
  int known_orders() const;
  double scale() const;
  struct Defect {
    double defect, size;
    double begun = 0;  // h |y'(0)|
  };
  Defect defect(const FirstOrderState<T>& end, const T& h);
  double rounding_of_time(const T& h);
  void take_extent(const FirstOrderState<T>& state);
  double extent() const;
  bool rests(const FirstOrderState<T>& begin, const FirstOrderState<T>& end);
  int orders_read() const { return this->options_.degree; }
  double jorba_zou(double max_step) const;
  void sum(const FirstOrderState<T>& from, const T& h, FirstOrderState<T>& to) const;
  T increment(std::size_t i, const T& h) const;
  bool series_is_finite(Report& report) const;
  bool is_finite(const FirstOrderState<T>& end, Report& report) const;
  void count();

  std::vector<T> rates_, at_end_;   // of the check
  std::vector<double> low_, high_;  // of y in steps that are given
};

// ---- definitions -----------------------------------------------------------------------------------------

template <class T>
void FirstOrderTaylor<T>::set_parameters(std::vector<T> parameters) {
  this->series_.series().set_parameters(parameters);
  this->options_.parameters = std::move(parameters);
}

template <class T>
void FirstOrderTaylor<T>::start(const FirstOrderState<T>& state, bool backwards) {
  if (!state.rest.empty() && state.rest.size() != state.y.size())
    throw std::invalid_argument("FirstOrderState: rest must be empty or as long as y");
  this->series_.lead_backwards(backwards);
  this->series_.start(state.time, state.y);
}

/// The orders from 0 on that are finite.
template <class T>
int FirstOrderTaylor<T>::known_orders() const {
  int k = 0;
  while (k <= series().order() && finite(series().norm(k))) ++k;
  return k - 1;
}

/// max |y| / max |y'| at the start: a time in which y changes.
template <class T>
double FirstOrderTaylor<T>::scale() const {
  using std::abs;
  return static_cast<double>(T(series().norm(0) / series().norm(1) * abs(series().time_unit())));
}

/// Whether y' = 0 at the start of the series, and of a y that is a little off in one component, f leads no farther off.
template <class T>
bool FirstOrderTaylor<T>::rests(const FirstOrderState<T>&, const FirstOrderState<T>&) {
  if (series().norm(1) != T(0)) return false;
  std::vector<T> y;
  for (int i = 0; i < series().size(); ++i) y.push_back(series()[i][0]);
  const T least = std::numeric_limits<T>::epsilon() * std::max(series().norm(0), T(1));
  for (std::size_t i = 0; i < y.size(); ++i)
    for (const T& off : {least, T(-least)}) {
      std::vector<T> beside = y;
      beside[i] += off;
      this->series_.series().rates(series().time(), beside, rates_);
      if (T(rates_[i] * off) > T(0)) return false;
    }
  return true;
}

/// h max |f(t (1 + eps)) - f(t)| at the end of a step, after `defect`: how much of a fast f the rounding of a late time hides.
template <class T>
double FirstOrderTaylor<T>::rounding_of_time(const T& h) {
  using std::abs;
  const T time = T(series().time() + h);
  const std::vector<T> here = rates_, y = at_end_;
  this->series_.series().rates(T(time + time * std::numeric_limits<T>::epsilon()), y, rates_);
  T most(0);
  for (std::size_t i = 0; i < here.size(); ++i)
    if (const T change = abs(T(rates_[i] - here[i])); most < change) most = change;
  return static_cast<double>(T(abs(h) * most));
}

/// h max |f(end) - y'(h)|, and max(|y(0)|, |y(h)|, h |f(end)|), all largest components; 0 where f(end) is not finite.
template <class T>
typename FirstOrderTaylor<T>::Defect FirstOrderTaylor<T>::defect(const FirstOrderState<T>& end, const T& h) {
  using std::abs;
  at_end_ = end.y;
  this->series_.series().rates(T(series().time() + h), end.y, rates_);
  const T s = h / series().time_unit();
  const T* w = this->series_.weights();
  const int top = this->top();
  T most(0), rate(0), size(0), begun(0);
  const auto take = [](T& largest, const T& x) {
    if (largest < x) largest = x;
  };
  for (std::size_t i = 0; i < end.y.size(); ++i) {
    const std::vector<T>& c = series()[static_cast<int>(i)];
    T slope(0);
    for (int k = top; k >= 1; --k) slope = slope * s + T(k) * w[k] * c[k];
    if (!finite(rates_[i])) return {0, std::numeric_limits<double>::infinity()};
    take(most, abs(T(rates_[i] - slope / series().time_unit())));
    take(rate, abs(rates_[i]));
    take(size, abs(end.y[i]));
    take(size, abs(c[0]));
    take(begun, abs(c[1]));
  }
  const T length = abs(h);
  take(size, T(length * rate));
  return {static_cast<double>(T(length * most)), static_cast<double>(size),
          static_cast<double>(T(length * begun / abs(series().time_unit())))};
}

template <class T>
void FirstOrderTaylor<T>::take_extent(const FirstOrderState<T>& state) {
  low_.resize(state.y.size(), std::numeric_limits<double>::infinity());
  high_.resize(state.y.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < state.y.size(); ++i) {
    low_[i] = std::min(low_[i], static_cast<double>(state.y[i]));
    high_[i] = std::max(high_[i], static_cast<double>(state.y[i]));
  }
}

template <class T>
double FirstOrderTaylor<T>::extent() const {
  double extent = 0;
  for (std::size_t i = 0; i < low_.size(); ++i) extent = std::max(extent, high_[i] - low_[i]);
  return extent;
}

template <class T>
std::vector<std::vector<T>> FirstOrderTaylor<T>::polynomials() const {
  std::vector<std::vector<T>> all;
  for (int i = 0; i < series().size(); ++i) {
    all.emplace_back();
    for (int k = 0; k <= this->top(); ++k)
      all.back().push_back(T(this->series_.weights()[k] * series()[i][k]));
  }
  return all;
}

template <class T>
double FirstOrderTaylor<T>::jorba_zou(double max_step) const {
  std::vector<double> norms(series().order() + 1);
  for (int k = 0; k <= series().order(); ++k) norms[k] = static_cast<double>(series().norm(k));
  return jorba_zou_step(norms, max_step);
}

template <class T>
void FirstOrderTaylor<T>::sum(const FirstOrderState<T>& from, const T& h, FirstOrderState<T>& to) const {
  to.y.resize(from.y.size());
  to.rest.resize(from.y.size());
  for (std::size_t i = 0; i < from.y.size(); ++i) {
    const T change = (from.rest.empty() ? T(0) : from.rest[i]) + increment(i, h);
    const TwoPart<T> next = two_sum(from.y[i], change);
    to.y[i] = next.high;
    to.rest[i] = next.low;
  }
}

/// y_i(begin + h) - y_i(begin).
template <class T>
T FirstOrderTaylor<T>::increment(std::size_t i, const T& h) const {
  const std::vector<T>& c = series()[static_cast<int>(i)];
  const T* w = this->series_.weights();
  const T s = h / series().time_unit();
  const int top = this->top();
  if (top == 0) return T(0);
  T horner = w[top] * c[top];
  for (int k = top - 1; k >= 1; --k) horner = horner * s + w[k] * c[k];
  return horner * s;
}

template <class T>
bool FirstOrderTaylor<T>::series_is_finite(Report& report) const {
  for (int k = 0; k <= series().order(); ++k)
    for (int i = 0; i < series().size(); ++i) {
      if (finite(series()[i][k])) continue;
      report = {Outcome::non_finite,
                "coefficient " + std::to_string(k) + " of y[" + std::to_string(i) +
                    "] is not finite at t = " + shown(series().time()) +
                    ": f is singular there, or the solution has blown up; end before",
                i};
      return false;
    }
  return true;
}

template <class T>
bool FirstOrderTaylor<T>::is_finite(const FirstOrderState<T>& end, Report& report) const {
  for (std::size_t i = 0; i < end.y.size(); ++i) {
    if (finite(end.y[i])) continue;
    report = {Outcome::non_finite,
              "y[" + std::to_string(i) + "] after the step from t = " + shown(series().time()) +
                  " is not finite: the solution has blown up; end before",
              static_cast<int>(i)};
    return false;
  }
  return true;
}

template <class T>
void FirstOrderTaylor<T>::count() {
  const std::uint64_t size = series().size(), order = series().order();
  this->work_.updates += size;
  this->work_.coefficients += order * size;
  this->work_.element_coefficients += order;
  this->work_.degrees += this->series_.stops().degree() * size;
}

extern template class OneClockTaylor<FirstOrderTaylor<double>, FirstOrderExpansion<double>,
                                     FirstOrderState<double>, FirstOrderOptions<double>>;
extern template class FirstOrderTaylor<double>;

}  // namespace jetlag
