// SPDX-License-Identifier: MIT
#pragma once
// A stopped series: the series of a step, which ends at a degree that is drawn, with the weights that keep it unbiased.
//
//     start        order 0 is known, or orders 0 and 1
//     draw         where the series will end, if that does not depend on its terms
//     grow_to      as far as the choice of the step wants to look
//     stop         the step is known: the draws in view of the terms, and the orders that are still missing
//
// The series may be of particles (motion/expansion.hpp) or of y' = f(t, y) (motion/first_order.hpp), in any number type.
// Series of particles with clocks of their own (schedule/) and in the lanes of ensembles are laid out otherwise and grown
// by others: they share the draws and weights (truncation/stops.hpp).

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/truncation/stops.hpp"

namespace jetlag {

/// Coefficients in powers of (t - time) / time_unit, grown order by order. norm(k): the size of coefficient k, not finite
/// where one of its components is not.
template <class S>
concept StoppableSeries = requires(S s, const S c, int k, typename S::Number t) {
  s.grow_to(k);
  s.restart(t);
  { c.order() } -> std::convertible_to<int>;
  { c.norm(k) } -> std::convertible_to<typename S::Number>;
  { c.time_unit() } -> std::convertible_to<typename S::Number>;
};

/// The unit of time for a series: its own, or where its last coefficients have over- or underflowed a double, a power of two
/// in which they should not.
///
/// The last coefficient m that is neither tells how fast they grow, as (c_m / c)^(1/m), c the larger one of c_0, c_1. A
/// series that ends, as that of free fall, looks like one that has underflowed, but its coefficients do not shrink that
/// fast before the end.
template <StoppableSeries Series>
double better_unit(const Series& series) {
  const int n = series.order();
  const double unit = std::abs(static_cast<double>(series.time_unit()));
  const auto size = [&](int k) { return static_cast<double>(series.norm(k)); };
  if (std::isnormal(std::max(size(n), size(n - 1)))) return unit;
  int m = 0, end = 0;
  double last = 0;
  for (; end <= n; ++end) {
    const double c = size(end);
    if (!std::isfinite(c)) break;
    if (!std::isnormal(c)) continue;
    m = end;
    last = c;
  }
  const double first = std::max(size(0), size(1));
  if (m < 2 || !std::isnormal(first)) return unit;
  const double growth = (std::log2(last) - std::log2(first)) / m;
  if (end <= n ? growth < 1 : growth > -16) return unit;
  return std::clamp(std::ldexp(unit, -static_cast<int>(std::lround(growth))), 0x1p-900, 0x1p900);
}

template <StoppableSeries Series>
class StoppedSeries {
 public:
  using T = typename Series::Number;

  /// beyond: orders that must be known beyond the degree, 1 where positions lead velocities of their own series.
  StoppedSeries(Series series, Stops stops, int beyond)
      : series_(std::move(series)), stops_(std::move(stops)), beyond_(beyond) {
    if constexpr (!std::is_same_v<T, double>) weights_.assign(stops_.draws() * stops_.terms(), T(1));
  }

  const Series& series() const { return series_; }
  Series& series() { return series_; }
  const Stops& stops() const { return stops_; }
  Stops& stops() { return stops_; }

  /// The series from a state: what Series::start takes, but for the unit of time, which is that of the last one.
  template <class... Start>
  void start(const Start&... from) {
    series_.start(from..., signed_unit());
  }
  /// Of the next start: whether the series leads backwards in time, in a negative unit.
  void lead_backwards(bool backwards) { backwards_ = backwards; }
  /// In seconds again, as for another motion.
  void forget_unit() { unit_ = 1; }

  /// Up to an order at least, in a unit of time in which the coefficients are representable: 1 until one is not.
  void grow_to(int order);

  void draw(std::uint64_t update) {
    if (stops_.wait_for_terms()) return;
    stops_.draw(update);
    take_weights();
  }

  /// Ends the series of a step of this length, with all that its sums need. The update is that of `draw`.
  void stop(const T& h, std::uint64_t update);

  /// The last term of a sum: the degree that all share, or where a step has failed before the series was grown to it the
  /// last one that is known.
  int top() const { return std::min(stops_.degree(), series_.order() - beyond_); }

  /// Weights of the terms up to the degree of a draw.
  const T* weights(std::size_t draw = 0) const {
    if constexpr (std::is_same_v<T, double>)
      return stops_.weights(draw);
    else
      return weights_.data() + draw * stops_.terms();
  }

 private:
  void take_weights();
  T signed_unit() const { return T(backwards_ ? -unit_ : unit_); }

  Series series_;
  Stops stops_;
  int beyond_;
  double unit_ = 1;
  bool backwards_ = false;
  std::vector<T> weights_;  // the same as numbers of this type, [draw][term]
};

template <StoppableSeries Series>
void StoppedSeries<Series>::grow_to(int order) {
  const int wanted = std::max(order, 1);  // a unit is seen from two coefficients
  if (wanted <= series_.order()) return;
  for (int attempt = 0; attempt < 4; ++attempt) {
    series_.grow_to(wanted);
    const double unit = better_unit(series_);
    if (unit == unit_) return;
    unit_ = unit;
    series_.restart(signed_unit());
  }
  series_.grow_to(wanted);
}

template <StoppableSeries Series>
void StoppedSeries<Series>::stop(const T& h, std::uint64_t update) {
  using std::abs;
  if (stops_.wait_for_terms()) {
    const auto size = [&](std::size_t draw, int n) {
      const auto norm = [&] {
        if constexpr (requires { series_.norm_of(draw, n); })
          return static_cast<double>(stops_.shared() ? series_.norm(n) : series_.norm_of(draw, n));
        else
          return static_cast<double>(series_.norm(n));
      };
      return norm() * std::pow(static_cast<double>(abs(T(h / series_.time_unit()))), n);
    };
    stops_.draw_in_view(update, size, [&](int degree) { grow_to(degree + beyond_); });
    take_weights();
  } else if (stops_.largest_degree() + beyond_ > series_.order()) {
    grow_to(stops_.largest_degree() + beyond_);
  }
}

template <StoppableSeries Series>
void StoppedSeries<Series>::take_weights() {
  if constexpr (!std::is_same_v<T, double>) {
    for (std::size_t draw = 0; draw < stops_.draws(); ++draw)
      for (int n = 0; n <= stops_.degree(draw); ++n)
        weights_[draw * stops_.terms() + n] = T(stops_.weights(draw)[n]);
  }
}

}  // namespace jetlag
