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

/// `eights` times eight numbers, of which the last eight may be fewer: others take the place of those.
template <int eights>
[[gnu::always_inline]] inline void load(const double* from, std::size_t bytes, Eight* into,
                                        double other = 0) {
  if (bytes < eights * sizeof(Eight)) into[eights - 1] = Eight{} + other;
  std::memcpy(into, from, bytes);
}

/// sum_{n=first..last} w(n) c_n s^(n-first).
template <int eights, class Weight>
[[gnu::always_inline]] inline void horner(const double* c, std::size_t next_order, std::size_t bytes,
                                          int first, int last, const Weight& w, double s, Eight* total) {
  for (int i = 0; i < eights; ++i) total[i] = Eight{};
  for (int n = last; n >= first; --n) {
    Eight next[eights];
    load<eights>(c + n * next_order, bytes, next);
    const double weight = w(n);
    for (int i = 0; i < eights; ++i) total[i] = total[i] * s + weight * next[i];
  }
}

[[gnu::always_inline]] inline void take(const Eight& numbers, Eight& largest) {
  const Eight size = numbers < -numbers ? -numbers : numbers;
  largest = largest < size ? size : largest;
}

template <int eights>
[[gnu::always_inline]] inline void sum(const double* c, std::size_t next_order, std::size_t bytes, int first,
                                       int last, const double* w, double s, double* into) {
  Eight total[eights];
  horner<eights>(c, next_order, bytes, first, last, [w](int n) { return w[n]; }, s, total);
  std::memcpy(into, total, bytes);
}

/// The largest sizes so far, eight of each.
struct Largest {
  Eight force{}, undefined{}, position{}, velocity[2]{}, acceleration[2]{};
};

template <int eights>
[[gnu::always_inline]] inline void compare(const double* x, const double* ahead, std::size_t next_order,
                                           std::size_t bytes, int last, const double* w, double s,
                                           Largest& largest) {
  Eight leads_to[eights], ends[2][3][eights];
  horner<eights>(x, next_order, bytes, 2, last, [w](int n) { return n * (n - 1) * w[n]; }, s, leads_to);
  for (int n = 0; n < 3; ++n) {
    load<eights>(x + n * next_order, bytes, ends[0][n]);
    load<eights>(ahead + n * next_order, bytes, ends[1][n]);
  }
  for (int i = 0; i < eights; ++i) {
    const Eight difference = 2.0 * ends[1][2][i] - leads_to[i];
    take(difference, largest.force);
    largest.undefined += difference - difference;
    for (int side = 0; side < 2; ++side) {
      take(ends[side][0][i], largest.position);
      take(ends[side][1][i], largest.velocity[side]);
      take(2.0 * ends[side][2][i], largest.acceleration[side]);
    }
  }
}

template <int eights>
[[gnu::always_inline]] inline bool outweighs(const double* c, std::size_t next_order, std::size_t bytes,
                                             int last, double h) {
  Eight rest[eights], next[eights];
  for (int i = 0; i < eights; ++i) rest[i] = Eight{};
  for (int k = last; k > 0; --k) {
    load<eights>(c + k * next_order, bytes, next);
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

}  // namespace

JETLAG_WIDE void sum_rows(const double* c, std::size_t next_order, std::size_t count, int first, int last,
                          const double* w, const double& s, double* into) {
  for_eights<4>(count,
                [=, s = s](auto eights, std::size_t begin, std::size_t bytes) __attribute__((always_inline)) {
                  sum<eights>(c + begin, next_order, bytes, first, last, w, s, into + begin);
                });
}

JETLAG_WIDE void compare_rows(const double* x, const double* ahead, std::size_t next_order, std::size_t count,
                              int last, const double* w, const double& s, RowDeparture<double>& departure) {
  Largest largest;
  for_eights<2>(count, [=, s = s, &largest](auto eights, std::size_t begin,
                                            std::size_t bytes) __attribute__((always_inline)) {
    compare<eights>(x + begin, ahead + begin, next_order, bytes, last, w, s, largest);
  });
  const auto take = [](double& most, const Eight& sizes) {
    for (std::size_t i = 0; i < lanes; ++i) most = std::max(most, sizes[i]);
  };
  take(departure.force, largest.force);
  for (std::size_t i = 0; i < lanes; ++i)
    if (!(largest.undefined[i] == 0)) departure.force = std::numeric_limits<double>::infinity();
  take(departure.position, largest.position);
  for (int side = 0; side < 2; ++side) {
    take(departure.velocity[side], largest.velocity[side]);
    take(departure.acceleration[side], largest.acceleration[side]);
  }
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
