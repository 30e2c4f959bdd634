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

namespace jetlag::testing {

template <class T>
struct RunningError {
  T value{};
  T error{};  // |value - exact| <= error

  static constexpr int function_ulps = 4;  // of exp, log, sin, cos, pow: glibc promises 2, Boost a few

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

  friend RunningError sqrt(const RunningError& a) {
    using std::sqrt;
    const T v = sqrt(a.value);
    return rounded(v, a.error / (v + v));
  }
  friend RunningError exp(const RunningError& a) {
    using std::exp;
    const T v = exp(a.value);
    return rounded(v, v * a.error, function_ulps);
  }
  friend RunningError log(const RunningError& a) {
    using std::log;
    return rounded(T(log(a.value)), a.error / size(a.value), function_ulps);
  }
  friend RunningError sin(const RunningError& a) {
    using std::sin;
    return rounded(T(sin(a.value)), a.error, function_ulps);
  }
  friend RunningError cos(const RunningError& a) {
    using std::cos;
    return rounded(T(cos(a.value)), a.error, function_ulps);
  }
  friend RunningError pow(const RunningError& a, const RunningError& b) {
    using std::log, std::pow;
    const T v = pow(a.value, b.value);
    return rounded(v, size(T(v * b.value / a.value)) * a.error + size(T(v * log(a.value))) * b.error,
                   function_ulps);
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
