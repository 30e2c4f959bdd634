// SPDX-License-Identifier: MIT
#pragma once
// What is read from a series as a whole, order by order: its sums and norms. Definitions of expansion.hpp, which includes them.

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <vector>

#include "jetlag/motion/expansion.hpp"

namespace jetlag {

template <class T>
void Expansion<T>::position_sum(int first, int last, const T* w, const T& s, Coordinates<T>& into) const {
  sum(x_, first, last, w, s, into);
}

template <class T>
void Expansion<T>::velocity_sum(int first, int last, const T* w, const T& s, Coordinates<T>& into) const {
  sum(v_, first, last, w, s, into);
}

template <class T>
bool Expansion<T>::motion_sum(int last, const T* w, const T& s, Coordinates<T>& position,
                              Coordinates<T>& velocity, AlignedVector<T>& leads_to) const {
  constexpr std::size_t width = 64;
  position.resize(particles_, dimension_);
  velocity.resize(particles_, dimension_);
  const std::size_t rows = row_size();
  leads_to.resize(rows);
  const bool padded = stride_ != dimension_;
  std::array<T, width> x, v;
  bool finite = true;
  for (std::size_t begin = 0; begin < rows; begin += width) {
    const std::size_t size = std::min(width, rows - begin);
    const MotionSums<T> into{padded ? x.data() : position.data() + begin,
                             padded ? v.data() : velocity.data() + begin, leads_to.data() + begin};
    finite =
        detail::sum_motion_rows(x_.data() + begin, v_.data() + begin, rows, size, last, w, s, into) && finite;
    if (!padded) continue;
    unpad(x.data(), begin / stride_, size / stride_, position);
    unpad(v.data(), begin / stride_, size / stride_, velocity);
  }
  return finite;
}

template <class T>
void Expansion<T>::weighted_series(int last, const T* w, Coefficients& position, Coefficients& velocity) const
  requires std::same_as<T, double>
{
  for (auto* terms : {&position, &velocity}) {
    const AlignedVector<T>& series = terms == &position ? x_ : v_;
    *terms = Coefficients(last + 1, particles_, dimension_);
    for (int n = 0; n <= last; ++n)
      detail::for_components(
          particles_, dimension_,
          [to = terms->data(n), from = series.data() + n * row_size(), weight = w[n], d = dimension_,
           stride = stride_](std::size_t i, int c) { to[i * d + c] = weight * from[i * stride + c]; });
  }
}

template <class T>
void Expansion<T>::curve(int last, const T& s, std::vector<T>& into) const {
  using std::abs;
  constexpr std::size_t width = 8;
  into.assign(particles_, T(0));
  const std::size_t rows = row_size();
  const int log_stride = std::bit_width(static_cast<unsigned>(stride_)) - 1;
  std::array<T, width> total;
  for (std::size_t begin = 0; begin < rows; begin += width) {
    const std::size_t size = std::min(width, rows - begin);
    total.fill(T(0));
    for (int n = last; n >= 2; --n) {
      const T* c = x_.data() + n * rows + begin;
      if (size == width)
        for (std::size_t i = 0; i < width; ++i) total[i] = (total[i] + abs(c[i])) * s;
      else
        for (std::size_t i = 0; i < size; ++i) total[i] = (total[i] + abs(c[i])) * s;
    }
    for (std::size_t i = 0; i < size; ++i) into[(begin + i) >> log_stride] += total[i] * s;
  }
}

template <class T>
void Expansion<T>::unpad(const T* padded, std::size_t first, std::size_t count, Coordinates<T>& rows) const {
  detail::for_components(static_cast<int>(count), dimension_,
                         [=, to = rows.data() + first * dimension_, d = dimension_, stride = stride_](
                             std::size_t i, int c) { to[i * d + c] = padded[i * stride + c]; });
}

template <class T>
T Expansion<T>::norm(const AlignedVector<T>& series, int k) const {
  using std::abs;
  assert(0 <= k && k <= order_);
  const T* c = series.data() + k * row_size();
  constexpr std::size_t lanes = 4;  // that do not wait for each other
  std::array<T, lanes> most{}, zero{};
  const auto take = [](const T& component, T& largest, T& undefined) {
    const T size = abs(component);
    largest = largest < size ? size : largest;
    undefined = undefined + size * T(0);
  };
  const std::size_t rows = row_size(), whole = rows / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) take(c[i + lane], most[lane], zero[lane]);
  for (std::size_t i = whole; i < rows; ++i) take(c[i], most[0], zero[0]);
  const T low = most[0] < most[1] ? most[1] : most[0], high = most[2] < most[3] ? most[3] : most[2];
  return (low < high ? high : low) + ((zero[0] + zero[1]) + (zero[2] + zero[3]));
}

template <class T>
void Expansion<T>::sum(const AlignedVector<T>& series, int first, int last, const T* w, const T& s,
                       Coordinates<T>& into) const {
  constexpr std::size_t width = 64;
  into.resize(particles_, dimension_);
  const std::size_t rows = row_size();
  std::array<T, width> total;
  for (std::size_t begin = 0; begin < rows; begin += width) {
    const std::size_t size = std::min(width, rows - begin);
    if (stride_ == dimension_) {
      detail::sum_rows(series.data() + begin, rows, size, first, last, w, s, into.data() + begin);
      continue;
    }
    detail::sum_rows(series.data() + begin, rows, size, first, last, w, s, total.data());
    unpad(total.data(), begin / stride_, size / stride_, into);
  }
}

}  // namespace jetlag
