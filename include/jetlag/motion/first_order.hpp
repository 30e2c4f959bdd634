// SPDX-License-Identifier: MIT
#pragma once
// First-order systems  y' = f(t, y, p):   y_{k+1} = f_k / (k+1).
//
//   auto lorenz = [](const auto& t, const auto& y, const auto& p) {
//     return std::array{p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]};
//   };
//   FirstOrderExpansion<> series(lorenz, 3, {10.0, 28.0, 8.0 / 3.0});
//   series.start(0.0, {-10.0, -1.0, 40.0});
//   series.grow_to(20);                        //  series[2][20] is coefficient 20 of y_2
//
// Numbers written in f are part of the recording and are doubles, whatever T is. The parameters p are of type T and
// may be changed without recording again; f(t, y) has none.
//
// Choices in f (select, abs, max ..) are decided where the series starts. The series of what decides them are at hand, so
// that a step may end where the first one changes: first_change.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/tape/program.hpp"
#include "jetlag/tape/recording.hpp"
#include "jetlag/tape/watched.hpp"

namespace jetlag {

/// The parameters p as f sees them while it is recorded.
class RecordedParameters {
 public:
  RecordedParameters(Recording& recording, int count) : recording_(&recording), count_(count) {}
  int size() const { return count_; }

  /// Throws std::invalid_argument where there is none.
  Recorded operator[](int number) const {
    if (number < 0 || number >= count_)
      throw std::invalid_argument("y' = f(t, y, p): f reads p[" + std::to_string(number) + "], p has " +
                                  std::to_string(count_) + " components");
    return recording_->parameter(number);
  }

 private:
  Recording* recording_;
  int count_;
};

/// The tape of f with its conditions: inputs are time and `size` positions of participant 0; `size` outputs; `parameters`
/// parameters.
/// f(t, y) or f(t, y, p) takes a scalar, a vector of `size` scalars and the parameters, and returns a container of
/// `size` scalars. Throws std::invalid_argument for another number of them.
template <class F>
Tape record_first_order(const F& f, int size, int parameters = 0) {
  Recording recording;
  std::vector<Recorded> y;
  for (int i = 0; i < size; ++i) y.push_back(recording.input({Input::Kind::position, 0, i}));
  const Recorded t = recording.input({Input::Kind::time, 0, 0});
  std::vector<Recorded> derivative;
  const auto take = [&](const auto& components) {
    for (const Recorded& component : components) derivative.push_back(component);
  };
  if constexpr (std::invocable<const F&, const Recorded&, const std::vector<Recorded>&,
                               const RecordedParameters&>) {
    take(f(t, y, RecordedParameters(recording, parameters)));
  } else {
    if (parameters > 0)
      throw std::invalid_argument("y' = f(t, y): f takes no parameters, got " + std::to_string(parameters));
    take(f(t, y));
  }
  if (static_cast<int>(derivative.size()) != size)
    throw std::invalid_argument("y' = f(t, y): f returns " + std::to_string(derivative.size()) +
                                " components, y has " + std::to_string(size));
  Tape tape = with_conditions(recording.finish(derivative));
  tape.parameters = parameters;
  return tape;
}

template <class T = double>
class FirstOrderExpansion {
 public:
  using Number = T;

  /// f: see record_first_order. size: number of equations. parameters: p, as many as f reads.
  template <class F>
  FirstOrderExpansion(const F& f, int size, const std::vector<T>& parameters = {}, int expected_degree = 20)
      : y_(size),
        blocks_(Program(record_first_order(f, size, static_cast<int>(parameters.size()))), 1, parameters,
                scalar_kernels<T>()),
        once_(blocks_.program(), 1, parameters, scalar_kernels<T>()) {
    once_.reserve(1);
    blocks_.reserve(expected_degree);
    for (std::vector<T>& series : y_) series.reserve(expected_degree + 1);
  }

  /// Other values of p from now on; start() comes next. Throws std::invalid_argument for another number of them.
  void set_parameters(const std::vector<T>& parameters) {
    const int capacity = blocks_.capacity();
    blocks_ = Blocks<T>(blocks_.program(), 1, parameters, scalar_kernels<T>());
    blocks_.reserve(capacity);
    once_ = Blocks<T>(blocks_.program(), 1, parameters, scalar_kernels<T>());
    once_.reserve(1);
    for (std::vector<T>& series : y_) series.clear();
  }

  /// Starts anew from y(t) = y: coefficient 0 is known. time_unit, not 0: the series are those in powers of
  /// (time - t) / time_unit. With a power of two their digits are the same; fast and slow motions need it, whose
  /// coefficients over- or underflow. A negative one leads backwards: choices are those of the time before t.
  void start(const T& t, const std::vector<T>& y, const T& time_unit = T(1)) {
    if (y.size() != y_.size())
      throw std::invalid_argument("y' = f(t, y): " + std::to_string(y_.size()) +
                                  " initial values are needed");
    time_ = t;
    for (std::size_t i = 0; i < y.size(); ++i) y_[i].assign(1, y[i]);
    restart(time_unit);
  }

  /// Starts anew from the same values, in another unit of time.
  void restart(const T& time_unit) {
    if (!(time_unit > T(0)) && !(time_unit < T(0)))
      throw std::invalid_argument("y' = f(t, y): the unit of time must not be 0");
    time_unit_ = time_unit;
    for (std::vector<T>& series : y_) series.resize(1);
  }

  /// The highest order that is known.
  int order() const { return static_cast<int>(y_.empty() ? 0 : y_[0].size()) - 1; }

  /// One more order. Throws std::logic_error before start().
  void grow() {
    const int k = order();
    if (k < 0) throw std::logic_error("FirstOrderExpansion: start() comes before grow()");
    const T time = k == 0 ? time_ : k == 1 ? time_unit_ : T(0);
    blocks_.reserve(k + 1 > blocks_.capacity() ? 2 * (k + 1) : k + 1);
    run(blocks_, k, time, [&](int i) -> const T& { return y_[i][k]; });
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const T rate = rate_of(blocks_, i, k);
      y_[i].push_back(T((time_unit_ == T(1) ? rate : T(rate * time_unit_)) / T(k + 1)));
    }
  }

  void grow_to(int order) {
    while (this->order() < order) grow();
  }

  /// f(t, y), apart from the series.   into: shape (size).
  void rates(const T& t, const std::vector<T>& y, std::vector<T>& into) {
    run(once_, 0, t, [&](int i) -> const T& { return y[i]; });
    into.resize(y_.size());
    for (std::size_t i = 0; i < y_.size(); ++i) into[i] = rate_of(once_, i, 0);
  }

  /// Whether f makes choices that may change.
  bool has_conditions() const { return !blocks_.program().conditions.empty(); }

  /// The first s in (0, h], in units of time, at which a choice that was made at the start would be made otherwise; see
  /// jetlag::first_change. h becomes shorter where the series of a condition does not reach so far.
  /// of_known: as far as the coefficients say that are known where others are not finite.
  std::optional<T> first_change(T& h, bool of_known = false) {
    std::optional<T> first;
    T most = h;
    const auto at = [&](Place place, int k) { return *blocks_.at(0, place, k); };
    for (const auto& condition : blocks_.program().conditions)
      find_first_change<T>(condition, at, order(), of_known, most, first);
    if (!first) h = most;
    return first;
  }

  const T& time() const { return time_; }
  /// The unit of time of the series.
  const T& time_unit() const { return time_unit_; }

  /// The largest absolute coefficient k of all components; infinite where one is not finite.
  T norm(int k) const {
    using std::abs, std::isfinite;
    T most(0);
    for (const std::vector<T>& series : y_) {
      if (!isfinite(series[k])) return std::numeric_limits<T>::infinity();
      const T size = abs(series[k]);
      if (most < size) most = size;
    }
    return most;
  }

  /// The coefficients 0 .. order() of component i.
  const std::vector<T>& operator[](int i) const { return y_[i]; }
  int size() const { return static_cast<int>(y_.size()); }

 private:
  template <class Y>
  static void run(Blocks<T>& blocks, int k, const T& time, const Y& y) {
    for (const auto& [place, input] : blocks.program().inputs)
      *blocks.at(0, place, k) = input.kind == Input::Kind::time ? time : y(input.component);
    blocks.run(0, k);
  }
  static T rate_of(Blocks<T>& blocks, std::size_t i, int k) {
    const Place place = blocks.program().outputs[i];
    return k > 0 && place.space == Place::Space::statics ? T(0) : *blocks.at(0, place, k);
  }

  T time_{}, time_unit_{1};
  std::vector<std::vector<T>> y_;
  Blocks<T> blocks_, once_;
};

}  // namespace jetlag
