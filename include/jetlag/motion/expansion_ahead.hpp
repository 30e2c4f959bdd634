// SPDX-License-Identifier: MIT
#pragma once
// A look at the next state, whose first orders stay for the start from there: definitions of expansion.hpp, which includes them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "jetlag/motion/expansion.hpp"

namespace jetlag {

template <class T>
bool Expansion<T>::pads(const Coordinates<T>& rows, const T* padded) const {
  bool same = true;
  detail::for_components(
      particles_, dimension_,
      [=, &same, from = rows.data(), d = dimension_, stride = stride_](std::size_t i, int c) {
        same = same & (padded[i * stride + c] == from[i * d + c]);
      });
  return same;
}

template <class T>
void Expansion<T>::look_ahead(const State<T>& state, int order) {
  if (order > capacity_) reserve(order);
  const std::size_t before = element_coefficients_;
  ahead_.is_known = false;
  ahead_.x.resize(x_.size(), T(0));
  ahead_.v.resize(v_.size(), T(0));
  swap_ahead();
  begin(state, time_unit_);
  grow_to(order);
  swap_ahead();
  ahead_.is_known = true;
  ahead_.element_coefficients = element_coefficients_ - before;
}

template <class T>
void Expansion<T>::forget_ahead() {
  element_coefficients_ -= std::exchange(ahead_.element_coefficients, 0);
  ahead_.is_known = false;
}

template <class T>
void Expansion<T>::swap_ahead() {
  x_.swap(ahead_.x);
  v_.swap(ahead_.v);
  rest_.swap(ahead_.rest);
  std::swap(time_, ahead_.time);
  std::swap(order_, ahead_.order);
}

/// Whether a start from this state would compute what is known ahead.
template <class T>
bool Expansion<T>::is_ahead(const State<T>& state, const T& time_unit) const {
  if (!ahead_.is_known || !(time_unit == time_unit_)) return false;
  if (!(state.time == ahead_.time) && std::ranges::any_of(laws_, &ElementBlocks<T>::reads_time)) return false;
  const bool has_rest = state.position_rest.size() > 0;
  return has_rest == !ahead_.rest.empty() && (!has_rest || pads(state.position_rest, ahead_.rest.data())) &&
         pads(state.position, ahead_.x.data()) && pads(state.velocity, ahead_.v.data());
}

template <class T>
void Expansion<T>::go_ahead(const T& time) {
  swap_ahead();
  time_ = time;
}

template <class T>
void Expansion<T>::take_departure(int last, const T* w, const T& s, int first, int end,
                                  Departure& departure) const {
  constexpr std::size_t width = 8;
  const std::size_t rows = row_size(), stop = static_cast<std::size_t>(end) * stride_;
  const auto larger = [](const T& a, const T& b) { return a < b ? b : a; };
  std::array<T, width> force{}, undefined{}, position{}, velocity[2]{}, acceleration[2]{};
  for (std::size_t begin = static_cast<std::size_t>(first) * stride_; begin < stop; begin += width) {
    const std::size_t size = std::min(width, stop - begin);
    const T *x = x_.data() + begin, *ahead = ahead_.x.data() + begin;
    const auto leads_to =
        detail::sums_of_eight(x, rows, size, 2, last, [w](int n) { return T(T(n * (n - 1)) * w[n]); }, s);
    const auto take = [&](std::size_t i) {
      using std::abs;
      const T before = T(2) * x[2 * rows + i], after = T(2) * ahead[2 * rows + i];
      const T difference = abs(T(after - leads_to[i]));
      force[i] = larger(force[i], difference);
      undefined[i] += difference - difference;
      position[i] = larger(larger(position[i], abs(x[i])), abs(ahead[i]));
      velocity[0][i] = larger(velocity[0][i], abs(x[rows + i]));
      velocity[1][i] = larger(velocity[1][i], abs(ahead[rows + i]));
      acceleration[0][i] = larger(acceleration[0][i], abs(before));
      acceleration[1][i] = larger(acceleration[1][i], abs(after));
    };
    if (size == width)
      for (std::size_t i = 0; i < width; ++i) take(i);
    else
      for (std::size_t i = 0; i < size; ++i) take(i);
  }
  for (std::size_t i = 0; i < width; ++i) {
    departure.force = larger(departure.force, force[i]);
    if (!(undefined[i] == T(0))) departure.force = std::numeric_limits<T>::infinity();
    departure.position = larger(departure.position, position[i]);
    for (int side = 0; side < 2; ++side) {
      departure.velocity[side] = larger(departure.velocity[side], velocity[side][i]);
      departure.acceleration[side] = larger(departure.acceleration[side], acceleration[side][i]);
    }
  }
}

}  // namespace jetlag
