// SPDX-License-Identifier: MIT
#pragma once
// A double that counts the multiplications done with it: cost is counted, not timed.

#include <cmath>
#include <concepts>
#include <cstdint>

namespace jetlag::testing {

struct Counted {
  double value = 0.0;
  inline static std::int64_t products = 0;

  Counted() = default;
  template <class X>
    requires std::convertible_to<X, double>
  Counted(X x) : value(static_cast<double>(x)) {}  // implicit: numbers are numbers

  friend Counted operator+(Counted a, Counted b) { return a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return a.value - b.value; }
  friend Counted operator-(Counted a) { return -a.value; }
  friend Counted operator*(Counted a, Counted b) {
    ++products;
    return a.value * b.value;
  }
  friend Counted operator/(Counted a, Counted b) { return a.value / b.value; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
  friend Counted sqrt(Counted a) { return std::sqrt(a.value); }
  friend Counted cbrt(Counted a) { return std::cbrt(a.value); }
  friend Counted exp(Counted a) { return std::exp(a.value); }
  friend Counted expm1(Counted a) { return std::expm1(a.value); }
  friend Counted log(Counted a) { return std::log(a.value); }
  friend Counted log1p(Counted a) { return std::log1p(a.value); }
  friend Counted log2(Counted a) { return std::log2(a.value); }
  friend Counted log10(Counted a) { return std::log10(a.value); }
  friend Counted sin(Counted a) { return std::sin(a.value); }
  friend Counted cos(Counted a) { return std::cos(a.value); }
  friend Counted tan(Counted a) { return std::tan(a.value); }
  friend Counted asin(Counted a) { return std::asin(a.value); }
  friend Counted acos(Counted a) { return std::acos(a.value); }
  friend Counted atan(Counted a) { return std::atan(a.value); }
  friend Counted sinh(Counted a) { return std::sinh(a.value); }
  friend Counted cosh(Counted a) { return std::cosh(a.value); }
  friend Counted tanh(Counted a) { return std::tanh(a.value); }
  friend Counted asinh(Counted a) { return std::asinh(a.value); }
  friend Counted acosh(Counted a) { return std::acosh(a.value); }
  friend Counted atanh(Counted a) { return std::atanh(a.value); }
  friend Counted erf(Counted a) { return std::erf(a.value); }
  friend Counted erfc(Counted a) { return std::erfc(a.value); }
  friend Counted pow(Counted a, Counted b) { return std::pow(a.value, b.value); }
  friend Counted hypot(Counted a, Counted b) { return std::hypot(a.value, b.value); }
  friend Counted atan2(Counted a, Counted b) { return std::atan2(a.value, b.value); }
  friend bool isfinite(Counted a) { return std::isfinite(a.value); }
};

}  // namespace jetlag::testing
