// SPDX-License-Identifier: MIT
#pragma once
// A number that carries a bound on its own rounding error, so that no test has to guess a tolerance.
//
// Each operation passes on the errors of its operands, to first order, and adds eps |result| for its own
// rounding: twice the half unit in the last place that IEEE arithmetic promises, which leaves room for the
// terms of second order. The value is computed by the same operations, so it has the bits of a plain T.
// Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 3.3.

#include <cmath>
#include <concepts>
#include <limits>
#include <ostream>
#include <type_traits>

#include "jetlag/series/constants.hpp"
#include "jetlag/series/functions/erf.hpp"
#include "jetlag/series/functions/stretch_invariants.hpp"

namespace jetlag::testing {

template <class T>
struct RunningError {
  T value{};
  T error{};  // |value - exact| <= error

  static constexpr int function_ulps = 6;  // of exp, log, sin, ...: glibc promises 4 (erfc 6), Boost a few

  RunningError() = default;
  template <class X>
    requires std::convertible_to<X, T>
  RunningError(const X& x) : value(x) {}  // implicit: numbers are exact
  RunningError(const T& x, const T& e) : value(x), error(e) {}

  friend RunningError operator+(const RunningError& a, const RunningError& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend RunningError operator-(const RunningError& a, const RunningError& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend RunningError operator*(const RunningError& a, const RunningError& b) {
    return rounded(a.value * b.value, size(a.value) * b.error + size(b.value) * a.error);
  }
  friend RunningError operator/(const RunningError& a, const RunningError& b) {
    const T q = a.value / b.value;
    return rounded(q, (a.error + size(q) * b.error) / size(b.value));
  }
  friend RunningError operator-(const RunningError& a) { return {-a.value, a.error}; }
  RunningError& operator+=(const RunningError& b) { return *this = *this + b; }
  RunningError& operator-=(const RunningError& b) { return *this = *this - b; }
  RunningError& operator*=(const RunningError& b) { return *this = *this * b; }
  RunningError& operator/=(const RunningError& b) { return *this = *this / b; }

  friend bool operator==(const RunningError& a, const RunningError& b) { return a.value == b.value; }
  friend bool operator<(const RunningError& a, const RunningError& b) { return a.value < b.value; }
  friend bool operator>(const RunningError& a, const RunningError& b) { return a.value > b.value; }
  friend bool operator<=(const RunningError& a, const RunningError& b) { return a.value <= b.value; }

  friend RunningError sqrt(const RunningError& a) {
    using std::sqrt;
    const T v = sqrt(a.value);
    return rounded(v, a.error / (v + v));
  }
  // f(a): the error of a is passed on by the derivative f'(a), or a bound of it.
  friend RunningError cbrt(const RunningError& a) {
    using std::cbrt;
    const T x = a.value;
    const T v = cbrt(x);
    return rounded(v, size(T(v / (3 * x))) * a.error, function_ulps);
  }
  friend RunningError exp(const RunningError& a) {
    using std::exp;
    const T v = exp(a.value);
    return rounded(v, size(T(v)) * a.error, function_ulps);
  }
  friend RunningError expm1(const RunningError& a) {
    using std::expm1;
    const T v = expm1(a.value);
    return rounded(v, size(T(v + T(1))) * a.error, function_ulps);
  }
  friend RunningError log(const RunningError& a) {
    using std::log;
    const T x = a.value;
    const T v = log(x);
    return rounded(v, size(T(1 / x)) * a.error, function_ulps);
  }
  friend RunningError log1p(const RunningError& a) {
    using std::log1p;
    const T x = a.value;
    const T v = log1p(x);
    return rounded(v, size(T(1 / (1 + x))) * a.error, function_ulps);
  }
  friend RunningError log2(const RunningError& a) {
    using std::log2;
    const T x = a.value;
    const T v = log2(x);
    return rounded(v, size(T(Constants<T>::log2_e() / x)) * a.error, function_ulps);
  }
  friend RunningError log10(const RunningError& a) {
    using std::log10;
    const T x = a.value;
    const T v = log10(x);
    return rounded(v, size(T(Constants<T>::log10_e() / x)) * a.error, function_ulps);
  }
  friend RunningError sin(const RunningError& a) {
    using std::sin;
    const T v = sin(a.value);
    return rounded(v, size(T(T(1))) * a.error, function_ulps);
  }
  friend RunningError cos(const RunningError& a) {
    using std::cos;
    const T v = cos(a.value);
    return rounded(v, size(T(T(1))) * a.error, function_ulps);
  }
  friend RunningError tan(const RunningError& a) {
    using std::tan;
    const T v = tan(a.value);
    return rounded(v, size(T(1 + v * v)) * a.error, function_ulps);
  }
  friend RunningError asin(const RunningError& a) {
    using std::asin, std::sqrt;
    const T x = a.value;
    const T v = asin(x);
    return rounded(v, size(T(1 / sqrt(T((1 - x) * (1 + x))))) * a.error, function_ulps);
  }
  friend RunningError acos(const RunningError& a) {
    using std::acos, std::sqrt;
    const T x = a.value;
    const T v = acos(x);
    return rounded(v, size(T(1 / sqrt(T((1 - x) * (1 + x))))) * a.error, function_ulps);
  }
  friend RunningError atan(const RunningError& a) {
    using std::atan;
    const T x = a.value;
    const T v = atan(x);
    return rounded(v, size(T(1 / (1 + x * x))) * a.error, function_ulps);
  }
  friend RunningError sinh(const RunningError& a) {
    using std::sinh, std::sqrt;
    const T v = sinh(a.value);
    return rounded(v, size(T(sqrt(T(1 + v * v)))) * a.error, function_ulps);
  }
  friend RunningError cosh(const RunningError& a) {
    using std::cosh;
    const T v = cosh(a.value);
    return rounded(v, size(T(v)) * a.error, function_ulps);
  }
  friend RunningError tanh(const RunningError& a) {
    using std::tanh;
    const T v = tanh(a.value);
    return rounded(v, size(T(T(1))) * a.error, function_ulps);
  }
  friend RunningError asinh(const RunningError& a) {
    using std::asinh, std::sqrt;
    const T x = a.value;
    const T v = asinh(x);
    return rounded(v, size(T(1 / sqrt(T(1 + x * x)))) * a.error, function_ulps);
  }
  friend RunningError acosh(const RunningError& a) {
    using std::acosh, std::sqrt;
    const T x = a.value;
    const T v = acosh(x);
    return rounded(v, size(T(1 / sqrt(T((x - 1) * (x + 1))))) * a.error, function_ulps);
  }
  friend RunningError atanh(const RunningError& a) {
    using std::atanh;
    const T x = a.value;
    const T v = atanh(x);
    return rounded(v, size(T(1 / ((1 - x) * (1 + x)))) * a.error, function_ulps);
  }
  friend RunningError erf(const RunningError& a) {
    using std::erf;
    const T x = a.value;
    const T v = erf(x);
    return rounded(v, size(T(Constants<T>::two_over_sqrt_pi() * exp_of_minus_square(x))) * a.error,
                   function_ulps);
  }
  friend RunningError erfc(const RunningError& a) {
    using std::erfc;
    const T x = a.value;
    const T v = erfc(x);
    return rounded(v, size(T(Constants<T>::two_over_sqrt_pi() * exp_of_minus_square(x))) * a.error,
                   function_ulps);
  }
  friend RunningError exp_of_minus_square(const RunningError& a) {
    using jetlag::exp_of_minus_square;
    const T x = a.value;
    const T v = exp_of_minus_square(x);
    return rounded(v, size(T(2 * x * v)) * a.error, function_ulps);
  }
  friend RunningError pow(const RunningError& a, const RunningError& b) {
    using std::log, std::pow;
    const T v = pow(a.value, b.value);
    return rounded(v, size(T(v * b.value / a.value)) * a.error + size(T(v * log(a.value))) * b.error,
                   function_ulps);
  }
  friend RunningError hypot(const RunningError& a, const RunningError& b) {
    using std::hypot;
    return rounded(T(hypot(a.value, b.value)), a.error + b.error, function_ulps);
  }
  friend RunningError atan2(const RunningError& a, const RunningError& b) {
    using std::atan2, std::hypot;
    return rounded(T(atan2(a.value, b.value)), (a.error + b.error) / T(hypot(a.value, b.value)),
                   function_ulps);
  }
  friend RunningError first_stretch_invariant(const RunningError& i, const RunningError& ii,
                                              const RunningError& j) {
    using jetlag::first_stretch_invariant;
    const RunningError a(first_stretch_invariant(i.value, ii.value, j.value)), b = (a * a - i) / 2;
    const RunningError left = b * b - ii - 2 * j * a;  // by how much a misses the equation
    return rounded(a.value, (size(left.value) + left.error) / (2 * size(T(a.value * b.value - j.value))));
  }
  friend RunningError second_stretch_invariant(const RunningError& i, const RunningError& j,
                                               const RunningError& a) {
    using jetlag::second_stretch_invariant;
    return {second_stretch_invariant(i.value, j.value, a.value), RunningError((a * a - i) / 2).error};
  }
  friend bool isfinite(const RunningError& a) {
    using std::isfinite;
    return isfinite(a.value);
  }
  friend std::ostream& operator<<(std::ostream& out, const RunningError& a) {
    return out << a.value << " +- " << a.error;
  }

 private:
  static T size(const T& x) { return x < T(0) ? T(-x) : x; }
  static RunningError rounded(const T& v, const T& inherited, int ulps = 1) {
    return {v, T(inherited + ulps * std::numeric_limits<T>::epsilon() * size(v))};
  }
};

template <class X>
inline constexpr bool carries_error = false;
template <class T>
inline constexpr bool carries_error<RunningError<T>> = true;

}  // namespace jetlag::testing

namespace jetlag {
/// The constants of T, wrong by a rounding each.
template <class T>
struct Constants<testing::RunningError<T>> {
  static testing::RunningError<T> log2_e() { return rounded(Constants<T>::log2_e()); }
  static testing::RunningError<T> log10_e() { return rounded(Constants<T>::log10_e()); }
  static testing::RunningError<T> two_over_sqrt_pi() { return rounded(Constants<T>::two_over_sqrt_pi()); }

 private:
  static testing::RunningError<T> rounded(const T& x) {
    return {x, T(2 * std::numeric_limits<T>::epsilon() * x)};
  }
};
}  // namespace jetlag
