// SPDX-License-Identifier: MIT
#include "jetlag/series/calculus/row_sums.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "jetlag/base/wide.hpp"

namespace jetlag::detail {

namespace {

constexpr std::size_t lanes = 8;

using Four [[gnu::vector_size(32)]] = double;
using Two [[gnu::vector_size(16)]] = double;

/// V is one number or several beside each other.
template <class V>
[[gnu::always_inline]] inline void load(const double* from, V& numbers) {
  std::memcpy(&numbers, from, sizeof numbers);
}

/// sum_{n=first..last} w(n) c_n s^(n-first), n times V.
template <class V, int n, class Weight>
[[gnu::always_inline]] inline void horner(const double* c, std::size_t next_order, int first, int last,
                                          const Weight& w, double s, V* total) {
  constexpr std::size_t width = sizeof(V) / sizeof(double);
  for (int i = 0; i < n; ++i) total[i] = V{};
  for (int k = last; k >= first; --k) {
    const double weight = w(k);
    for (int i = 0; i < n; ++i) {
      V next;
      load(c + k * next_order + i * width, next);
      total[i] = total[i] * s + weight * next;
    }
  }
}

template <class V>
[[gnu::always_inline]] inline void take(const V& numbers, V& largest) {
  const V size = numbers < -numbers ? -numbers : numbers;
  largest = largest < size ? size : largest;
}

template <class V, int n, class Weight>
[[gnu::always_inline]] inline void sum(const double* c, std::size_t next_order, int first, int last,
                                       const Weight& w, double s, double* into) {
  V total[n];
  horner<V, n>(c, next_order, first, last, w, s, total);
  std::memcpy(into, total, sizeof total);
}

/// The largest sizes so far, as many of each as V has numbers.
template <class V>
struct Largest {
  V force{}, undefined{}, position{}, velocity[2]{}, acceleration[2]{};

  void add_to(RowDeparture<double>& departure) const {
    const auto for_each = [](const V& numbers, const auto& f) {
      double each[sizeof(V) / sizeof(double)];
      std::memcpy(each, &numbers, sizeof numbers);
      for (const double number : each) f(number);
    };
    const auto take = [&](double& most, const V& sizes) {
      for_each(sizes, [&](double size) { most = std::max(most, size); });
    };
    take(departure.force, force);
    for_each(undefined, [&](double number) {
      if (number != 0) departure.force = std::numeric_limits<double>::infinity();
    });
    take(departure.position, position);
    for (int side = 0; side < 2; ++side) {
      take(departure.velocity[side], velocity[side]);
      take(departure.acceleration[side], acceleration[side]);
    }
  }
};

template <class V, int n>
[[gnu::always_inline]] inline void compare(const double* x, const double* ahead, std::size_t next_order,
                                           int last, const double* w, double s, Largest<V>& largest) {
  constexpr std::size_t width = sizeof(V) / sizeof(double);
  V leads_to[n];
  horner<V, n>(x, next_order, 2, last, [w](int k) { return k * (k - 1) * w[k]; }, s, leads_to);
  for (int i = 0; i < n; ++i) {
    V ends[2][3];
    for (int k = 0; k < 3; ++k) {
      load(x + k * next_order + i * width, ends[0][k]);
      load(ahead + k * next_order + i * width, ends[1][k]);
    }
    const V difference = 2.0 * ends[1][2] - leads_to[i];
    take(difference, largest.force);
    largest.undefined += difference - difference;
    for (int side = 0; side < 2; ++side) {
      take(ends[side][0], largest.position);
      take(ends[side][1], largest.velocity[side]);
      const V acceleration = 2.0 * ends[side][2];
      take(acceleration, largest.acceleration[side]);
    }
  }
}

/// `eights` times eight numbers, of which the last eight may be fewer: others take the place of those.
template <int eights>
[[gnu::always_inline]] inline void load(const double* from, std::size_t bytes, Eight* into, double other) {
  if (bytes < eights * sizeof(Eight)) into[eights - 1] = Eight{} + other;
  std::memcpy(into, from, bytes);
}

template <int eights>
[[gnu::always_inline]] inline bool outweighs(const double* c, std::size_t next_order, std::size_t bytes,
                                             int last, double h) {
  Eight rest[eights], next[eights];
  for (int i = 0; i < eights; ++i) rest[i] = Eight{};
  for (int k = last; k > 0; --k) {
    load<eights>(c + k * next_order, bytes, next, 0);
    const double weight = k >= last - 1 ? 1000 : 1;
    for (int i = 0; i < eights; ++i)
      rest[i] = (rest[i] + weight * (next[i] < -next[i] ? -next[i] : next[i])) * h;
  }
  load<eights>(c, bytes, next, 1);
  auto is_less = (rest[0] < next[0]) | (rest[0] < -next[0]);
  for (int i = 1; i < eights; ++i) is_less &= (rest[i] < next[i]) | (rest[i] < -next[i]);
  std::int64_t all = -1;
  for (std::size_t lane = 0; lane < lanes; ++lane) all &= is_less[lane];
  return all != 0;
}

/// Calls f(eights, begin, bytes) for all numbers, `most` times eight of them at a time while there are so many.
template <int most, class F>
[[gnu::always_inline]] inline void for_eights(std::size_t count, const F& f) {
  std::size_t begin = 0;
  for (; begin + most * lanes <= count; begin += most * lanes)
    f(std::integral_constant<int, most>{}, begin, most * sizeof(Eight));
  for (; begin + lanes <= count; begin += lanes) f(std::integral_constant<int, 1>{}, begin, sizeof(Eight));
  if (begin < count) f(std::integral_constant<int, 1>{}, begin, (count - begin) * sizeof(double));
}

/// Calls f(V, n, begin) for all numbers, n times V of them: Eights as long as there are so many, `most` at a time, then fewer.
template <int most, class F>
[[gnu::always_inline]] inline void for_widths(std::size_t count, const F& f) {
  using One = std::integral_constant<int, 1>;
  std::size_t begin = 0;
  for (; begin + most * lanes <= count; begin += most * lanes)
    f(std::type_identity<Eight>{}, std::integral_constant<int, most>{}, begin);
  for (; begin + lanes <= count; begin += lanes) f(std::type_identity<Eight>{}, One{}, begin);
  if (count & 4) f(std::type_identity<Four>{}, One{}, begin);
  begin += count & 4;
  if (count & 2) f(std::type_identity<Two>{}, One{}, begin);
  begin += count & 2;
  if (count & 1) f(std::type_identity<double>{}, One{}, begin);
}

}  // namespace

JETLAG_WIDE void sum_rows(const double* c, std::size_t next_order, std::size_t count, int first, int last,
                          const double* w, const double& s, double* into) {
  for_widths<4>(count, [=, s = s](auto numbers, auto times,
                                  std::size_t begin) __attribute__((always_inline)) {
    const auto weight = [w](int k) { return w[k]; };
    sum<typename decltype(numbers)::type, times>(c + begin, next_order, first, last, weight, s, into + begin);
  });
}

JETLAG_WIDE void sum_rows(const double* c, std::size_t next_order, std::size_t count, int last, double s,
                          double* into) {
  for_widths<4>(count, [=](auto numbers, auto times, std::size_t begin) __attribute__((always_inline)) {
    const auto weight = [](int) { return 1.0; };
    sum<typename decltype(numbers)::type, times>(c + begin, next_order, 0, last, weight, s, into + begin);
  });
}

JETLAG_WIDE void sum_at_times(const double* c, std::size_t next_order, int last, const double* s,
                              double* into) {
  static_assert(sizeof(Four) == times_beside * sizeof(double));
  Four time, total{};
  load(s, time);
  for (int k = last; k >= 0; --k) total = total * time + c[k * next_order];
  std::memcpy(into, &total, sizeof total);
}

JETLAG_WIDE void compare_rows(const double* x, const double* ahead, std::size_t next_order, std::size_t count,
                              int last, const double* w, const double& s, RowDeparture<double>& departure) {
  Largest<Eight> of_eights;
  for_widths<2>(count, [=, s = s, &of_eights, &departure](auto numbers, auto times, std::size_t begin)
                           __attribute__((always_inline)) {
                             using V = typename decltype(numbers)::type;
                             if constexpr (sizeof(V) == sizeof(Eight)) {
                               compare<V, times>(x + begin, ahead + begin, next_order, last, w, s, of_eights);
                             } else {
                               Largest<V> largest;
                               compare<V, times>(x + begin, ahead + begin, next_order, last, w, s, largest);
                               largest.add_to(departure);
                             }
                           });
  if (count >= lanes) of_eights.add_to(departure);
}

JETLAG_WIDE bool outweighs_rest(const double* c, std::size_t next_order, std::size_t count, int last,
                                const double& h) {
  bool all = true;
  for_eights<4>(count, [=, h = h, &all](auto eights, std::size_t begin, std::size_t bytes)
                           __attribute__((always_inline)) {
                             all = all && outweighs<eights>(c + begin, next_order, bytes, last, h);
                           });
  return all;
}

}  // namespace jetlag::detail
