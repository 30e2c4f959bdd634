// SPDX-License-Identifier: MIT
#pragma once
// A number for straight code: for the recurrences of a law compiled as one function (series/online/online.hpp).

#include <cmath>
#include <concepts>
#include <numbers>

#include "jetlag/series/constants.hpp"
#include "jetlag/series/function_names.hpp"
#include "jetlag/series/functions.hpp"

namespace jetlag {

/// A double of which products are added in one rounding, and whose sums are unrolled, the newest terms last. Fused
/// multiply-adds are instructions only in functions compiled for processors that have them; elsewhere they are slow calls.
struct Unrolled {
  double value;
  Unrolled() = default;
  constexpr Unrolled(double x) : value(x) {}  // implicit: numbers are numbers
};

template <>
inline constexpr bool is_unrolled<Unrolled> = true;

inline Unrolled operator+(Unrolled a, Unrolled b) { return a.value + b.value; }
inline Unrolled operator-(Unrolled a, Unrolled b) { return a.value - b.value; }
inline Unrolled operator-(Unrolled a) { return -a.value; }
inline Unrolled operator*(Unrolled a, Unrolled b) { return a.value * b.value; }
inline Unrolled operator/(Unrolled a, Unrolled b) { return a.value / b.value; }
/// By an order, which is known: its reciprocal is.
template <std::same_as<int> Order>
inline Unrolled operator/(Unrolled a, Order k) {
  return a.value * (1.0 / k);
}

template <>
inline Unrolled multiply_add(const Unrolled& a, const Unrolled& b, const Unrolled& c) {
  return __builtin_fma(a.value, b.value, c.value);
}
template <>
inline Unrolled over(const Unrolled& a, const Unrolled& b) {
  return a.value * (1.0 / b.value);
}

template <>
struct Constants<Unrolled> {
  static Unrolled log2_e() { return std::numbers::log2e; }
  static Unrolled log10_e() { return std::numbers::log10e; }
  static Unrolled two_over_sqrt_pi() { return 2 * std::numbers::inv_sqrtpi; }
};

// The functions that rules call at order 0.

inline Unrolled sqrt(Unrolled a) { return __builtin_sqrt(a.value); }
/// Half powers, as of gravity, are roots: an exponent is mostly known.
inline Unrolled pow(Unrolled a, Unrolled b) {
  if (b.value == -1.5) return 1.0 / (a.value * __builtin_sqrt(a.value));
  return std::pow(a.value, b.value);
}
#define JETLAG_OF_UNROLLED(f) \
  inline Unrolled f(Unrolled a) { return std::f(a.value); }
JETLAG_FUNCTIONS_OF_ONE(JETLAG_OF_UNROLLED)
#undef JETLAG_OF_UNROLLED
inline Unrolled hypot(Unrolled a, Unrolled b) { return std::hypot(a.value, b.value); }
inline Unrolled atan2(Unrolled a, Unrolled b) { return std::atan2(a.value, b.value); }
inline Unrolled exp_of_minus_square(Unrolled a) { return jetlag::exp_of_minus_square(a.value); }
inline Unrolled first_stretch_invariant(Unrolled i, Unrolled ii, Unrolled j) {
  return jetlag::first_stretch_invariant(i.value, ii.value, j.value);
}
inline Unrolled second_stretch_invariant(Unrolled i, Unrolled j, Unrolled a) {
  return jetlag::second_stretch_invariant(i.value, j.value, a.value);
}

}  // namespace jetlag
