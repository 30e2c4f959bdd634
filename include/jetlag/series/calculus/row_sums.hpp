// SPDX-License-Identifier: MIT
#pragma once
// Sums over the orders of a series, for the numbers of a row of an expansion beside each other. Those of doubles are compiled for
// each instruction set, with the same bits from all of them.

#include <cmath>
#include <cstddef>
#include <limits>

namespace jetlag {

/// By how much a force departs from what a series leads to, and how large the motion is: largest components, in metres.
/// u: the unit of time; velocity and acceleration at the beginning and at the end.
template <class T>
struct RowDeparture {
  T force{0};     // u^2 |a - sum_{n=2..last} n (n-1) w_n x_n s^(n-2)| [m]; infinite where it is not a number
  T position{0};  // |x| on both sides [m]
  T velocity[2]{};      // u |v| [m]
  T acceleration[2]{};  // u^2 |a| [m]
};

/// Where the sums of a motion go: a number for each of a row.
template <class T>
struct MotionSums {
  T* position;
  T* velocity;
  T* acceleration;  // u^2 a [m], u the unit of time
};

namespace detail {

/// sum_{n=first..last} w_n c_n s^(n-first), by Horner's rule, of `count` numbers; those of order n begin at c + n next_order.
template <class T>
void sum_rows(const T* c, std::size_t next_order, std::size_t count, int first, int last, const T* w,
              const T& s, T* into) {
  for (std::size_t i = 0; i < count; ++i) {
    T total(0);
    for (int n = last; n >= first; --n) total = total * s + w[n] * c[n * next_order + i];
    into[i] = total;
  }
}
void sum_rows(const double* c, std::size_t next_order, std::size_t count, int first, int last,
              const double* w, const double& s, double* into);
/// With weights 1 from order 0 on: sum_{n=0..last} c_n s^n.
void sum_rows(const double* c, std::size_t next_order, std::size_t count, int last, double s, double* into);

/// One number at several times s: the same sums.
inline constexpr std::size_t times_beside = 4;
void sum_at_times(const double* c, std::size_t next_order, int last, const double* s, double* into);

/// The accelerations u^2 a = sum_{n=2..last} n (n-1) w_n x_n s^(n-2) to which positions lead, by Horner's rule.
template <class T>
void sum_accelerations(const T* x, std::size_t next_order, std::size_t count, int last, const T* w,
                       const T& s, T* into) {
  for (std::size_t i = 0; i < count; ++i) {
    T total(0);
    for (int n = last; n >= 2; --n) total = total * s + T(T(n * (n - 1)) * w[n]) * x[n * next_order + i];
    into[i] = total;
  }
}
void sum_accelerations(const double* x, std::size_t next_order, std::size_t count, int last, const double* w,
                       const double& s, double* into);

/// The sums of orders 0 to last of positions and velocities, and the accelerations above, at once: each as if it were alone. A
/// sum waits for itself at each order, three of them do not wait for each other. Returns whether positions and velocities are
/// finite.
template <class T>
bool sum_motion_rows(const T* x, const T* v, std::size_t next_order, std::size_t count, int last, const T* w,
                     const T& s, const MotionSums<T>& into) {
  sum_rows(x, next_order, count, 0, last, w, s, into.position);
  sum_rows(v, next_order, count, 0, last, w, s, into.velocity);
  sum_accelerations(x, next_order, count, last, w, s, into.acceleration);
  T undefined(0);
  for (std::size_t i = 0; i < count; ++i)
    undefined = undefined + (into.position[i] - into.position[i]) + (into.velocity[i] - into.velocity[i]);
  return undefined == T(0);
}
bool sum_motion_rows(const double* x, const double* v, std::size_t next_order, std::size_t count, int last,
                     const double* w, const double& s, const MotionSums<double>& into);

/// Takes in how far the accelerations to which the coefficients x lead are from those at the end, `ahead`, which are known to
/// order 2.
template <class T>
void compare_ends(const T* leads_to, const T* x, const T* ahead, std::size_t next_order, std::size_t count,
                  RowDeparture<T>& departure) {
  using std::abs;
  const auto take = [](T& most, const T& size) {
    if (most < size) most = size;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const T difference = abs(T(T(2) * ahead[2 * next_order + i] - leads_to[i]));
    take(departure.force, difference);
    if (!(difference - difference == T(0))) departure.force = std::numeric_limits<T>::infinity();
    const T* ends[]{x + i, ahead + i};
    for (int side = 0; side < 2; ++side) {
      take(departure.position, abs(ends[side][0]));
      take(departure.velocity[side], abs(ends[side][next_order]));
      take(departure.acceleration[side], T(T(2) * abs(ends[side][2 * next_order])));
    }
  }
}
void compare_ends(const double* leads_to, const double* x, const double* ahead, std::size_t next_order,
                  std::size_t count, RowDeparture<double>& departure);

/// Whether |c_0| > sum_{k=1..last} w_k |c_k| h^k for all of the numbers, where w_k = 1000 for the last two orders, which stand for
/// all that follow, and 1 for the others.
template <class T>
bool outweighs_rest(const T* c, std::size_t next_order, std::size_t count, int last, const T& h) {
  using std::abs;
  for (std::size_t i = 0; i < count; ++i) {
    T rest(0);
    for (int k = last; k > 0; --k)
      rest = (rest + T(k >= last - 1 ? 1000 : 1) * abs(c[k * next_order + i])) * h;
    if (!(rest < abs(c[i]))) return false;
  }
  return true;
}
bool outweighs_rest(const double* c, std::size_t next_order, std::size_t count, int last, const double& h);

}  // namespace detail

}  // namespace jetlag
