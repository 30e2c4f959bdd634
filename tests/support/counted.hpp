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
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend Counted sqrt(Counted a) { return std::sqrt(a.value); }
  friend Counted exp(Counted a) { return std::exp(a.value); }
  friend Counted log(Counted a) { return std::log(a.value); }
  friend Counted sin(Counted a) { return std::sin(a.value); }
  friend Counted cos(Counted a) { return std::cos(a.value); }
  friend Counted pow(Counted a, Counted b) { return std::pow(a.value, b.value); }
  friend bool isfinite(Counted a) { return std::isfinite(a.value); }
};

}  // namespace jetlag::testing
