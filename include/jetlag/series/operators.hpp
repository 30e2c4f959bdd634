// SPDX-License-Identifier: MIT
#pragma once
// + - * / of series, and of series with plain numbers, by the rules of arithmetic.hpp.

#include <concepts>

#include "jetlag/series/arithmetic.hpp"

namespace jetlag {

/// Numbers that mix with series of type S.
template <class X, class S>
concept ScalarOf = !std::same_as<X, S> && std::convertible_to<X, typename S::value_type>;

/// A base class that gives S its operators. They are hidden friends, so that only series look at them.
template <class S>
struct SeriesOperators {
  friend S operator+(const S& u) { return u; }
  friend S operator-(const S& u) { return lift<Negate, S>(u); }
  friend S operator+(const S& u, const S& v) { return lift<Add, S>(u, v); }
  friend S operator-(const S& u, const S& v) { return lift<Subtract, S>(u, v); }
  friend S operator*(const S& u, const S& v) { return lift<Multiply, S>(u, v); }
  friend S operator/(const S& f, const S& g) { return lift<Divide, S>(f, g); }

  template <ScalarOf<S> X>
  friend S operator+(const S& u, const X& c) {
    return lift<Offset, S>(c, u);
  }
  template <ScalarOf<S> X>
  friend S operator+(const X& c, const S& u) {
    return lift<Offset, S>(c, u);
  }
  template <ScalarOf<S> X>
  friend S operator-(const S& u, const X& c) {
    return lift<Offset, S>(-typename S::value_type(c), u);
  }
  template <ScalarOf<S> X>
  friend S operator-(const X& c, const S& u) {
    return lift<Offset, S>(c, -u);
  }
  template <ScalarOf<S> X>
  friend S operator*(const S& u, const X& c) {
    return lift<Scale, S>(c, u);
  }
  template <ScalarOf<S> X>
  friend S operator*(const X& c, const S& u) {
    return lift<Scale, S>(c, u);
  }
  template <ScalarOf<S> X>
  friend S operator/(const S& f, const X& c) {
    return lift<DivideByConstant, S>(f, c);
  }
  template <ScalarOf<S> X>
  friend S operator/(const X& c, const S& g) {
    using T = typename S::value_type;
    if (T(c) == T(0)) return S(c) / g;  // 0 / t = 0
    return lift<Reciprocal, S>(c, g);
  }

  friend S& operator+=(S& u, const S& v) { return u = u + v; }
  friend S& operator-=(S& u, const S& v) { return u = u - v; }
  friend S& operator*=(S& u, const S& v) { return u = u * v; }
  friend S& operator/=(S& u, const S& v) { return u = u / v; }
};

}  // namespace jetlag
