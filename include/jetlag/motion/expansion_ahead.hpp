// SPDX-License-Identifier: MIT
#pragma once
// A look at the next state, whose first orders stay for the start from there: definitions of expansion.hpp, which includes them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "jetlag/motion/expansion.hpp"

namespace jetlag {

template <class T>
bool Expansion<T>::pads(const Coordinates<T>& rows, const T* padded) const {
  if (stride_ == dimension_) return std::equal(rows.data(), rows.data() + row_size(), padded);
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
  if (ahead_.x.size() != x_.size()) {
    ahead_.x.resize(x_.size(), T(0));
    ahead_.v.resize(v_.size(), T(0));
  }
  swap_ahead();
  begin(state, time_unit_);
  grow_to(order);
  swap_ahead();
  ahead_.is_known = elements_are_ahead_ = true;
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
  std::swap(is_rolled_up_, ahead_.is_rolled_up);
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
  elements_are_ahead_ = false;
}

template <class T>
void Expansion<T>::take_departure(int last, const T* w, const T& s, int first, int end,
                                  Departure& departure) const {
  constexpr std::size_t width = 64;
  std::array<T, width> leads_to;
  const std::size_t stop = static_cast<std::size_t>(end) * stride_;
  for (std::size_t begin = static_cast<std::size_t>(first) * stride_; begin < stop; begin += width) {
    const std::size_t size = std::min(width, stop - begin);
    detail::sum_accelerations(x_.data() + begin, row_size(), size, last, w, s, leads_to.data());
    detail::compare_ends(leads_to.data(), x_.data() + begin, ahead_.x.data() + begin, row_size(), size,
                         departure);
  }
}

template <class T>
void Expansion<T>::take_departure(const AlignedVector<T>& leads_to, int first, int end,
                                  Departure& departure) const {
  const std::size_t begin = static_cast<std::size_t>(first) * stride_;
  detail::compare_ends(leads_to.data() + begin, x_.data() + begin, ahead_.x.data() + begin, row_size(),
                       static_cast<std::size_t>(end - first) * stride_, departure);
}

}  // namespace jetlag
