// SPDX-License-Identifier: MIT
#pragma once
// First-order systems  y' = f(t, y):   y_{k+1} = f_k / (k+1).
//
//   auto lorenz = [](const auto& t, const auto& y) {
//     return std::array{10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]};
//   };
//   FirstOrderExpansion<> series(lorenz, 3);
//   series.start(0.0, {-10.0, -1.0, 40.0});
//   series.grow_to(20);                        //  series[2][20] is coefficient 20 of y_2

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/tape/program.hpp"
#include "jetlag/tape/recording.hpp"

namespace jetlag {

/// The tape of f: inputs are time and `size` positions of participant 0; `size` outputs.
/// f(t, y) takes a scalar and a vector of scalars and returns a container of `size` scalars.
template <class F>
Tape record_first_order(const F& f, int size) {
  Recording recording;
  std::vector<Recorded> y;
  for (int i = 0; i < size; ++i) y.push_back(recording.input({Input::Kind::position, 0, i}));
  const Recorded t = recording.input({Input::Kind::time, 0, 0});
  std::vector<Recorded> derivative;
  for (const Recorded& component : f(t, y)) derivative.push_back(component);
  if (static_cast<int>(derivative.size()) != size)
    throw std::invalid_argument("y' = f(t, y): f returns " + std::to_string(derivative.size()) +
                                " components, y has " + std::to_string(size));
  return recording.finish(derivative);
}

template <class T = double>
class FirstOrderExpansion {
 public:
  /// f: see record_first_order. size: number of equations.
  template <class F>
  FirstOrderExpansion(const F& f, int size, int expected_degree = 20)
      : y_(size), blocks_(Program(record_first_order(f, size)), 1, {}, scalar_kernels<T>()) {
    blocks_.reserve(expected_degree);
  }

  /// Starts anew from y(t) = y: coefficient 0 is known.
  void start(const T& t, const std::vector<T>& y) {
    if (y.size() != y_.size())
      throw std::invalid_argument("y' = f(t, y): " + std::to_string(y_.size()) +
                                  " initial values are needed");
    time_ = t;
    for (std::size_t i = 0; i < y.size(); ++i) y_[i].assign(1, y[i]);
  }

  /// The highest order that is known.
  int order() const { return static_cast<int>(y_.empty() ? 0 : y_[0].size()) - 1; }

  /// One more order. Throws std::logic_error before start().
  void grow() {
    const int k = order();
    if (k < 0) throw std::logic_error("FirstOrderExpansion: start() comes before grow()");
    blocks_.reserve(k + 1 > blocks_.capacity() ? 2 * (k + 1) : k + 1);
    for (const auto& [place, input] : blocks_.program().inputs)
      *blocks_.at(0, place, k) =
          input.kind == Input::Kind::time ? (k == 0 ? time_ : T(k == 1 ? 1 : 0)) : y_[input.component][k];
    blocks_.run(0, k);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const Place place = blocks_.program().outputs[i];
      const bool zero = k > 0 && place.space == Place::Space::statics;
      y_[i].push_back(zero ? T(0) : T(*blocks_.at(0, place, k) / T(k + 1)));
    }
  }

  void grow_to(int order) {
    while (this->order() < order) grow();
  }

  /// The coefficients 0 .. order() of component i.
  const std::vector<T>& operator[](int i) const { return y_[i]; }
  int size() const { return static_cast<int>(y_.size()); }

 private:
  T time_{};
  std::vector<std::vector<T>> y_;
  Blocks<T> blocks_;
};

}  // namespace jetlag
