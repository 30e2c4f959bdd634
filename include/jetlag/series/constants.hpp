// SPDX-License-Identifier: MIT
#pragma once
// The irrational constants of the rules, in the precision of a number type.

#include <cmath>
#include <complex>
#include <concepts>
#include <numbers>

namespace jetlag {

/// For any number type with sqrt, log and atan: a rounding or two. Specialised for the types that know better.
template <class T>
struct Constants {
  static T log2_e() {  // 1 / log(2)
    using std::log;
    return T(T(1) / log(T(2)));
  }
  static T log10_e() {  // 1 / log(10)
    using std::log;
    return T(T(1) / log(T(10)));
  }
  static T two_over_sqrt_pi() {  // pi = 4 atan(1)
    using std::atan, std::sqrt;
    return T(T(1) / sqrt(T(atan(T(1)))));
  }
};

/// Those of the real numbers.
template <class T>
struct Constants<std::complex<T>> : Constants<T> {};

/// The nearest number: 2 / sqrt(pi) is doubled exactly.
template <std::floating_point T>
struct Constants<T> {
  static T log2_e() { return std::numbers::log2e_v<T>; }
  static T log10_e() { return std::numbers::log10e_v<T>; }
  static T two_over_sqrt_pi() { return 2 * std::numbers::inv_sqrtpi_v<T>; }
};

}  // namespace jetlag
