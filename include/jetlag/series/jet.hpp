// SPDX-License-Identifier: MIT
#pragma once
// Jet<T, N>: a truncated Taylor series used as a number.
//
// A jet of degree N holds the coefficients of  u(t) = u_0 + u_1 t + ... + u_N t^N,  always normalised:
// u_k = u^(k)(0)/k!. It is closed under arithmetic and the elementary functions: terms beyond t^N are dropped.
// A function written once for numbers, called with the jet  x + t,  returns its own Taylor series at x:
//
//   Jet<double, 3> x = Jet<double, 3>::variable(2.0);       //  2 + t
//   auto y = x * x * x;                                     //  8 + 12 t + 6 t^2 + t^3
//   auto z = 1.0 / (x - 1.0);                               //  1 - t + t^2 - t^3
//
// by hand: (2 + t)^3 = 8 + 12 t + 6 t^2 + t^3, and 1/(1 + t) is the geometric series.
//
// Where a function is not analytic at the point (sqrt at 0, division by 0) the jet is not finite from the
// first coefficient that does not exist. Where a quotient has a removable singularity (t/t) the common power
// of t is cancelled; the top coefficients, which the known ones do not determine, are then NaN.
//
// T is any number type with + - * / and, for the functions used, sqrt, exp, ... found by argument-dependent
// lookup; its operators must return T (Boost.Multiprecision: et_off).

#include <array>
#include <cassert>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>

#include "jetlag/series/arithmetic.hpp"
#include "jetlag/series/polynomial.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

template <class T, int N>
class Jet {
  static_assert(N >= 0);

 public:
  using value_type = T;
  static constexpr int degree = N;

  Jet() : c_{} { c_.fill(T(0)); }

  /// The constant series x.
  template <class X>
    requires std::convertible_to<X, T>
  Jet(const X& x) : Jet() {  // implicit: numbers are jets
    c_[0] = T(x);
  }

  /// From coefficients u_0, u_1, ...; the missing ones are 0, at most N + 1 are given.
  static Jet from(std::initializer_list<T> coefficients) {
    assert(coefficients.size() <= N + 1);
    Jet u;
    int k = 0;
    for (const T& c : coefficients) u.c_[k++] = c;
    return u;
  }

  /// x + t.
  static Jet variable(const T& x) {
    Jet u(x);
    if constexpr (N >= 1) u.c_[1] = T(1);
    return u;
  }

  T& operator[](int k) {
    assert(0 <= k && k <= N);
    return c_[k];
  }
  const T& operator[](int k) const {
    assert(0 <= k && k <= N);
    return c_[k];
  }
  const std::array<T, N + 1>& coefficients() const { return c_; }

  /// u(t), by Horner's rule. Also for another type X of argument, such as a jet (composition); the result is of
  /// the wider type, as it is for a product.
  template <class X>
    requires requires(const T& c, const X& t) { c* t + c; }
  auto operator()(const X& t) const {
    using Value = std::decay_t<decltype(c_[0] * t + c_[0])>;
    return evaluate<Value>(c_, Value(t));
  }

  Jet& operator+=(const Jet& v) { return *this = *this + v; }
  Jet& operator-=(const Jet& v) { return *this = *this - v; }
  Jet& operator*=(const Jet& v) { return *this = *this * v; }
  Jet& operator/=(const Jet& v) { return *this = *this / v; }

  friend bool operator==(const Jet& u, const Jet& v) { return u.c_ == v.c_; }

 private:
  std::array<T, N + 1> c_;
};

template <class S>
inline constexpr bool is_jet = false;
template <class T, int N>
inline constexpr bool is_jet<Jet<T, N>> = true;

/// A number x read as a series without terms beyond the first: the `constant` operand of a rule.
template <class T>
struct ConstantSeries {
  T value;
  const T& operator[](int) const { return value; }
};

namespace detail {
template <class J, class X>
decltype(auto) as_operand(const X& x) {
  if constexpr (std::is_same_v<X, J>)
    return (x);
  else
    return ConstantSeries<typename J::value_type>{typename J::value_type(x)};
}
}  // namespace detail

/// v = R(u...): the rule applied for k = 0, 1, ..., N. Operands that are not jets of type J are constants.
template <Rule R, class J, class... U>
  requires is_jet<J>
J lift(const U&... u) {
  J v;
  for (int k = 0; k <= J::degree; ++k) v[k] = R::coefficient(k, detail::as_operand<J>(u)..., v);
  return v;
}

/// v = A(u, w), w = B(u, v): two rules that read each other's older coefficients.
template <Rule A, Rule B, class J>
  requires is_jet<J>
std::pair<J, J> lift_coupled(const J& u) {
  std::pair<J, J> both;
  auto& [v, w] = both;
  for (int k = 0; k <= J::degree; ++k) {
    v[k] = A::coefficient(k, u, w, v);
    w[k] = B::coefficient(k, u, v, w);
  }
  return both;
}

// ---- arithmetic ------------------------------------------------------------------------------------------

template <class X, class J>
concept ScalarOf = is_jet<J> && !is_jet<X> && std::convertible_to<X, typename J::value_type>;

template <class T, int N>
Jet<T, N> operator+(const Jet<T, N>& u) {
  return u;
}
template <class T, int N>
Jet<T, N> operator-(const Jet<T, N>& u) {
  return lift<Negate, Jet<T, N>>(u);
}
template <class T, int N>
Jet<T, N> operator+(const Jet<T, N>& u, const Jet<T, N>& v) {
  return lift<Add, Jet<T, N>>(u, v);
}
template <class T, int N>
Jet<T, N> operator-(const Jet<T, N>& u, const Jet<T, N>& v) {
  return lift<Subtract, Jet<T, N>>(u, v);
}
template <class T, int N>
Jet<T, N> operator*(const Jet<T, N>& u, const Jet<T, N>& v) {
  return lift<Multiply, Jet<T, N>>(u, v);
}

/// Smallest k with u_k != 0; N + 1 for the zero series.
template <class T, int N>
int valuation(const Jet<T, N>& u) {
  int k = 0;
  while (k <= N && u[k] == T(0)) ++k;
  return k;
}

/// f / g. Where g_0 = 0 and f vanishes to the same order l, t^l is cancelled and the last l coefficients are NaN.
template <class T, int N>
Jet<T, N> operator/(const Jet<T, N>& f, const Jet<T, N>& g) {
  const int l = valuation(g);
  if (l == 0 || l > N || valuation(f) < l) return lift<Divide, Jet<T, N>>(f, g);
  Jet<T, N> f_shifted, g_shifted;
  for (int k = 0; k + l <= N; ++k) {
    f_shifted[k] = f[k + l];
    g_shifted[k] = g[k + l];
  }
  auto q = lift<Divide, Jet<T, N>>(f_shifted, g_shifted);
  for (int k = N - l + 1; k <= N; ++k) q[k] = T(std::numeric_limits<double>::quiet_NaN());
  return q;
}

template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator+(const Jet<T, N>& u, const X& c) {
  return lift<Offset, Jet<T, N>>(c, u);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator+(const X& c, const Jet<T, N>& u) {
  return u + c;
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator-(const Jet<T, N>& u, const X& c) {
  return lift<Offset, Jet<T, N>>(-T(c), u);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator-(const X& c, const Jet<T, N>& u) {
  return lift<Offset, Jet<T, N>>(c, -u);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator*(const Jet<T, N>& u, const X& c) {
  return lift<Scale, Jet<T, N>>(c, u);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator*(const X& c, const Jet<T, N>& u) {
  return u * c;
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator/(const Jet<T, N>& f, const X& c) {
  return lift<DivideByConstant, Jet<T, N>>(f, c);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> operator/(const X& c, const Jet<T, N>& g) {
  return lift<Reciprocal, Jet<T, N>>(c, g);
}

// ---- calculus --------------------------------------------------------------------------------------------

/// u'; its coefficient N is not determined by u and is set to 0: the derivative of the polynomial.
template <class T, int N>
Jet<T, N> derivative(const Jet<T, N>& u) {
  Jet<T, N> v;
  for (int k = 0; k < N; ++k) v[k] = (k + 1) * u[k + 1];
  return v;
}

/// The polynomial u about a new origin: v(t) = u(s + t).
template <class T, int N>
Jet<T, N> shift_origin(const Jet<T, N>& u, const T& s) {
  auto c = u.coefficients();
  taylor_shift(c, s);
  Jet<T, N> v;
  for (int k = 0; k <= N; ++k) v[k] = c[k];
  return v;
}

}  // namespace jetlag
