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

#define JETLAG_INLINE [[gnu::always_inline]] inline

// V is one number or several beside each other.
template <class V>
constexpr std::size_t width = sizeof(V) / sizeof(double);

template <class V>
JETLAG_INLINE void load(const double* from, V& numbers) {
  std::memcpy(&numbers, from, sizeof numbers);
}
template <class V>
JETLAG_INLINE void store(double* to, const V& numbers) {
  std::memcpy(to, &numbers, sizeof numbers);
}
template <class V>
JETLAG_INLINE void take(const V& numbers, V& largest) {
  const V size = numbers < -numbers ? -numbers : numbers;
  largest = largest < size ? size : largest;
}

// ---- how many at a time -----------------------------------------------------------------------------------

/// Calls f(V, n, begin) for numbers from begin on, n times V of them: `most` at a time, then fewer.
template <class V, int most, class F>
JETLAG_INLINE void for_registers(std::size_t count, std::size_t& begin, const F& f) {
  for (; begin + most * width<V> <= count; begin += most * width<V>)
    f(std::type_identity<V>{}, std::integral_constant<int, most>{}, begin);
  if constexpr (most > 1) for_registers<V, most / 2>(count, begin, f);
}

/// The same for all numbers, those that are left over in narrower registers.
template <class V, int most, class F>
JETLAG_INLINE void for_all(std::size_t count, const F& f) {
  std::size_t begin = 0;
  for_registers<V, most>(count, begin, f);
  if constexpr (width<V> >= 8) for_registers<FourNumbers, 1>(count, begin, f);
  if constexpr (width<V> >= 4) for_registers<TwoNumbers, 1>(count, begin, f);
  for_registers<double, 1>(count, begin, f);
}

// ---- sums -------------------------------------------------------------------------------------------------

/// sum_{n=first..last} w(n) c_n s^(n-first), n times V.
template <class V, int n, class Weight>
JETLAG_INLINE void sum(const double* c, std::size_t next_order, int first, int last, const Weight& w,
                       double s, double* into) {
  V total[n] = {};
  for (int k = last; k >= first; --k) {
    const double weight = w(k);
    for (int i = 0; i < n; ++i) {
      V next;
      load(c + k * next_order + i * width<V>, next);
      total[i] = total[i] * s + weight * next;
    }
  }
  for (int i = 0; i < n; ++i) store(into + i * width<V>, total[i]);
}

struct SumRows {
  template <class V>
  JETLAG_INLINE static void run(const double* c, std::size_t next_order, std::size_t count, int first,
                                int last, const double* w, double s, double* into) {
    for_all<V, 4>(count, [=](auto v, auto n, std::size_t begin) __attribute__((always_inline)) {
      const auto weight = [w](int k) __attribute__((always_inline)) { return w[k]; };
      sum<typename decltype(v)::type, n>(c + begin, next_order, first, last, weight, s, into + begin);
    });
  }
};

/// The same with weights 1, from order 0 on.
struct SumRowsOfOnes {
  template <class V>
  JETLAG_INLINE static void run(const double* c, std::size_t next_order, std::size_t count, int last,
                                double s, double* into) {
    for_all<V, 4>(count, [=](auto v, auto n, std::size_t begin) __attribute__((always_inline)) {
      const auto weight = [](int) __attribute__((always_inline)) { return 1.0; };
      sum<typename decltype(v)::type, n>(c + begin, next_order, 0, last, weight, s, into + begin);
    });
  }
};

/// One number at several times, each in a place of a register of its own.
struct SumAtTimes {
  template <class V>
  JETLAG_INLINE static void run(const double* c, std::size_t next_order, int last, const double* s,
                                double* into) {
    using W = std::conditional_t<(width<V> < times_beside), V, FourNumbers>;
    static_assert(width<FourNumbers> == times_beside);
    for (std::size_t begin = 0; begin < times_beside; begin += width<W>) {
      W time, total{};
      load(s + begin, time);
      for (int k = last; k >= 0; --k) total = total * time + c[k * next_order];
      store(into + begin, total);
    }
  }
};

struct SumAccelerations {
  template <class V>
  JETLAG_INLINE static void run(const double* x, std::size_t next_order, std::size_t count, int last,
                                const double* w, double s, double* into) {
    for_all<V, 4>(count, [=](auto v, auto n, std::size_t begin) __attribute__((always_inline)) {
      const auto weight = [w](int k) __attribute__((always_inline)) { return k * (k - 1) * w[k]; };
      sum<typename decltype(v)::type, n>(x + begin, next_order, 2, last, weight, s, into + begin);
    });
  }
};

/// Three sums for each number, which do not wait for each other. Adds 0 times all of them to `undefined`.
template <class V, int n>
JETLAG_INLINE void sum_motion(const double* x, const double* v, std::size_t next_order, int last,
                              const double* w, double s, const MotionSums<double>& into, V& undefined) {
  V position[n] = {}, velocity[n] = {}, acceleration[n] = {};
  const auto add = [&](int k, auto reaches_acceleration) __attribute__((always_inline)) {
    const double weight = w[k], weight_of_acceleration = k * (k - 1) * weight;
    for (int i = 0; i < n; ++i) {
      V next, next_velocity;
      load(x + k * next_order + i * width<V>, next);
      load(v + k * next_order + i * width<V>, next_velocity);
      position[i] = position[i] * s + weight * next;
      velocity[i] = velocity[i] * s + weight * next_velocity;
      if constexpr (reaches_acceleration)
        acceleration[i] = acceleration[i] * s + weight_of_acceleration * next;
    }
  };
  for (int k = last; k >= 2; --k) add(k, std::true_type{});
  for (int k = std::min(last, 1); k >= 0; --k) add(k, std::false_type{});
  for (int i = 0; i < n; ++i) {
    store(into.position + i * width<V>, position[i]);
    store(into.velocity + i * width<V>, velocity[i]);
    store(into.acceleration + i * width<V>, acceleration[i]);
    undefined += (position[i] - position[i]) + (velocity[i] - velocity[i]);
  }
}

struct SumMotionRows {
  template <class V>
  JETLAG_INLINE static bool run(const double* x, const double* v, std::size_t next_order, std::size_t count,
                                int last, const double* w, double s, MotionSums<double> into) {
    double undefined = 0;
    for_all<V, 4>(count, [=, &undefined](auto of, auto n, std::size_t begin) __attribute__((always_inline)) {
      using W = typename decltype(of)::type;
      W each = {};
      sum_motion<W, n>(x + begin, v + begin, next_order, last, w, s,
                       {into.position + begin, into.velocity + begin, into.acceleration + begin}, each);
      double numbers[width<W>];
      store(numbers, each);
      for (const double number : numbers) undefined += number;
    });
    return undefined == 0;
  }
};

// ---- ends -------------------------------------------------------------------------------------------------

/// The largest sizes so far, as many of each as V has numbers.
template <class V>
struct Largest {
  V force{}, undefined{}, position{}, velocity[2]{}, acceleration[2]{};

  JETLAG_INLINE void add_to(RowDeparture<double>& departure) const {
    take_in(force, departure.force);
    take_in(position, departure.position);
    for (int side = 0; side < 2; ++side) {
      take_in(velocity[side], departure.velocity[side]);
      take_in(acceleration[side], departure.acceleration[side]);
    }
    double numbers[width<V>];
    store(numbers, undefined);
    for (const double number : numbers)
      if (number != 0) departure.force = std::numeric_limits<double>::infinity();
  }

 private:
  JETLAG_INLINE static void take_in(const V& sizes, double& most) {
    double numbers[width<V>];
    store(numbers, sizes);
    for (const double number : numbers) most = std::max(most, number);
  }
};

template <class V>
JETLAG_INLINE void compare(const double* leads_to, const double* x, const double* ahead,
                           std::size_t next_order, Largest<V>& largest) {
  V ends[2][3], acceleration;
  for (int k = 0; k < 3; ++k) {
    load(x + k * next_order, ends[0][k]);
    load(ahead + k * next_order, ends[1][k]);
  }
  load(leads_to, acceleration);
  const V difference = 2.0 * ends[1][2] - acceleration;
  take(difference, largest.force);
  largest.undefined += difference - difference;
  for (int side = 0; side < 2; ++side) {
    take(ends[side][0], largest.position);
    take(ends[side][1], largest.velocity[side]);
    const V twice = 2.0 * ends[side][2];
    take(twice, largest.acceleration[side]);
  }
}

struct CompareEnds {
  template <class V>
  JETLAG_INLINE static void run(const double* leads_to, const double* x, const double* ahead,
                                std::size_t next_order, std::size_t count, RowDeparture<double>* departure) {
    Largest<V> of_widest;
    for_all<V, 1>(count, [=, &of_widest](auto v, auto, std::size_t begin) __attribute__((always_inline)) {
      using W = typename decltype(v)::type;
      if constexpr (std::is_same_v<W, V>) {
        compare<W>(leads_to + begin, x + begin, ahead + begin, next_order, of_widest);
      } else {
        Largest<W> largest;
        compare<W>(leads_to + begin, x + begin, ahead + begin, next_order, largest);
        largest.add_to(*departure);
      }
    });
    if (count >= width<V>) of_widest.add_to(*departure);
  }
};

// ---- weights ----------------------------------------------------------------------------------------------

template <class V, int n>
JETLAG_INLINE bool outweighs(const double* c, std::size_t next_order, int last, double h) {
  V rest[n] = {};
  for (int k = last; k > 0; --k) {
    const double weight = k >= last - 1 ? 1000 : 1;
    for (int i = 0; i < n; ++i) {
      V next;
      load(c + k * next_order + i * width<V>, next);
      rest[i] = (rest[i] + weight * (next < -next ? -next : next)) * h;
    }
  }
  bool all = true;
  for (int i = 0; i < n; ++i) {
    double rests[width<V>];
    store(rests, rest[i]);
    for (std::size_t lane = 0; lane < width<V>; ++lane) {
      const double first = c[i * width<V> + lane];
      all = all & ((rests[lane] < first) | (rests[lane] < -first));
    }
  }
  return all;
}

struct OutweighsRest {
  template <class V>
  JETLAG_INLINE static bool run(const double* c, std::size_t next_order, std::size_t count, int last,
                                double h) {
    bool all = true;
    for_all<V, 4>(count, [=, &all](auto v, auto n, std::size_t begin) __attribute__((always_inline)) {
      all = all && outweighs<typename decltype(v)::type, n>(c + begin, next_order, last, h);
    });
    return all;
  }
};

}  // namespace

void sum_rows(const double* c, std::size_t next_order, std::size_t count, int first, int last,
              const double* w, const double& s, double* into) {
  with_widest_registers<SumRows>(c, next_order, count, first, last, w, s, into);
}

void sum_rows(const double* c, std::size_t next_order, std::size_t count, int last, double s, double* into) {
  with_widest_registers<SumRowsOfOnes>(c, next_order, count, last, s, into);
}

void sum_at_times(const double* c, std::size_t next_order, int last, const double* s, double* into) {
  with_widest_registers<SumAtTimes>(c, next_order, last, s, into);
}

void sum_accelerations(const double* x, std::size_t next_order, std::size_t count, int last, const double* w,
                       const double& s, double* into) {
  with_widest_registers<SumAccelerations>(x, next_order, count, last, w, s, into);
}

bool sum_motion_rows(const double* x, const double* v, std::size_t next_order, std::size_t count, int last,
                     const double* w, const double& s, const MotionSums<double>& into) {
  return with_widest_registers<SumMotionRows>(x, v, next_order, count, last, w, s, into);
}

void compare_ends(const double* leads_to, const double* x, const double* ahead, std::size_t next_order,
                  std::size_t count, RowDeparture<double>& departure) {
  with_widest_registers<CompareEnds>(leads_to, x, ahead, next_order, count, &departure);
}

bool outweighs_rest(const double* c, std::size_t next_order, std::size_t count, int last, const double& h) {
  return with_widest_registers<OutweighsRest>(c, next_order, count, last, h);
}

#undef JETLAG_INLINE

}  // namespace jetlag::detail
