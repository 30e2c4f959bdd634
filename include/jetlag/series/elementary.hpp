// SPDX-License-Identifier: MIT
#pragma once
// The elementary functions, written once for everything that `lift` serves: jets, and the recording scalar
// of a tape (tape/recording.hpp).

#include <cmath>
#include <concepts>

#include "jetlag/series/checked.hpp"
#include "jetlag/series/constants.hpp"
#include "jetlag/series/functions.hpp"
#include "jetlag/series/jet.hpp"

namespace jetlag {

// Plain numbers: jetlag::sin(x) is written for all.
using std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::cos,
    std::cosh, std::erf, std::erfc, std::exp, std::expm1, std::hypot, std::log, std::log10, std::log1p,
    std::log2, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;

template <class J>
  requires is_jet<J>
struct Constants<J> {
  using T = typename J::value_type;
  static J log2_e() { return Constants<T>::log2_e(); }
  static J log10_e() { return Constants<T>::log10_e(); }
  static J two_over_sqrt_pi() { return Constants<T>::two_over_sqrt_pi(); }
};

/// True for the types that the elementary functions of this file take. Specialised by each of them.
template <class S>
inline constexpr bool is_series = is_jet<S>;

template <class S>
concept Series = is_series<S>;

/// Range: all reals.
template <Series S>
S square(const S& u) {
  return lift<Square, S>(u);
}

/// Range: u_0 > 0. At u_0 = 0 coefficient 1 is the first that is not finite.
template <Series S>
S sqrt(const S& u) {
  return lift<Sqrt, S>(u);
}

/// Range: u_0 != 0, or u vanishes as a power of t^3. Else coefficient 1 is not finite at u_0 = 0.
template <Series S>
S cbrt(const S& u) {
  return lift<Cbrt, S>(u);
}

// ---- exponentials and logarithms -------------------------------------------------------------------------

/// Range: all reals.
template <Series S>
S exp(const S& u) {
  return lift<Exp, S>(u);
}

/// exp(u) - 1, without cancellation at u_0 = 0.   Range: all reals.
template <Series S>
S expm1(const S& u) {
  return lift<Expm1, S>(u, exp(u));
}

/// Range: u_0 > 0. At u_0 = 0 coefficient 0 is not finite.
template <Series S>
S log(const S& u) {
  return lift<Log, S>(u);
}

/// log(1 + u), without cancellation at u_0 = 0.   Range: u_0 > -1. At u_0 = -1 coefficient 0 is not finite.
template <Series S>
S log1p(const S& u) {
  return lift<Log1p, S>(u);
}

/// Range: u_0 > 0. At u_0 = 0 coefficient 0 is not finite.
template <Series S>
S log2(const S& u) {
  return lift<Log2, S>(u);
}

/// Range: u_0 > 0. At u_0 = 0 coefficient 0 is not finite.
template <Series S>
S log10(const S& u) {
  return lift<Log10, S>(u);
}

// ---- trigonometric functions and their inverses ----------------------------------------------------------

/// Range: all reals.
template <Series S>
S sin(const S& u) {
  return lift_coupled<Sin, Cos>(u).first;
}

/// Range: all reals.
template <Series S>
S cos(const S& u) {
  return lift_coupled<Sin, Cos>(u).second;
}

/// Range: u_0 is no odd multiple of pi/2.
template <Series S>
S tan(const S& u) {
  return lift_coupled<Tan, SecantSquared>(u).first;
}

/// Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
template <Series S>
S asin(const S& u) {
  return lift<Asin, S>(u, sqrt(lift<OneMinusSquare, S>(u)));
}

/// Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
template <Series S>
S acos(const S& u) {
  return lift<Acos, S>(u, sqrt(lift<OneMinusSquare, S>(u)));
}

/// Range: all reals; beyond 1e154, the square of which overflows, coefficient 2 is not finite.
template <Series S>
S atan(const S& u) {
  return lift<Atan, S>(u, 1.0 + square(u));
}

// ---- polar coordinates -----------------------------------------------------------------------------------

namespace detail {
/// (x^2 + y^2) / h_0, h_0 = hypot(x_0, y_0).
template <Series S>
S scaled_squares(const S& x, const S& y) {
  return lift<ScaledSumOfSquares, S>(lift<Length, S>(x, y), x, y);
}
template <Series S, ScalarOf<S> X>
S scaled_squares(const S& x, const X& c) {
  return lift<ScaledSquare, S>(lift<Length, S>(x, c), x);
}
}  // namespace detail

/// sqrt(x^2 + y^2), without overflow.   Range: (x_0, y_0) != (0, 0). There an even common power t^l is taken out of
/// jets; with an odd one there is a kink: coefficient l is the first that is not finite. In other series it is 1.
template <Series S>
S hypot(const S& x, const S& y) {
  return detail::without_common_power<1>(
      [](const S& a, const S& b) { return lift<RootOfScaled, S>(detail::scaled_squares(a, b)); }, x, y);
}
template <Series S, ScalarOf<S> X>
S hypot(const S& x, const X& c) {
  if (c == X(0)) return hypot(x, S(c));
  return lift<RootOfScaled, S>(detail::scaled_squares(x, c));
}
template <Series S, ScalarOf<S> X>
S hypot(const X& c, const S& y) {
  return hypot(y, c);
}

/// The angle of (x, y), in [-pi, pi] at t = 0.   Range: (x_0, y_0) != (0, 0). There an even common power of t is
/// cancelled in jets; with an odd one the angle jumps, and as in other series coefficient 0 is not finite.
template <Series S>
S atan2(const S& y, const S& x) {
  return detail::without_common_power<0>(
      [](const S& b, const S& a) { return lift<Atan2, S>(b, a, detail::scaled_squares(a, b)); }, y, x);
}
template <Series S, ScalarOf<S> X>
S atan2(const S& y, const X& c) {
  if (c == X(0)) return atan2(y, S(c));
  return lift<Atan2OverConstant, S>(c, y, detail::scaled_squares(y, c));
}
template <Series S, ScalarOf<S> X>
S atan2(const X& c, const S& x) {
  if (c == X(0)) return atan2(S(c), x);
  return lift<Atan2OfConstant, S>(c, x, detail::scaled_squares(x, c));
}

// ---- hyperbolic functions and their inverses -------------------------------------------------------------

/// Range: all reals.
template <Series S>
S sinh(const S& u) {
  return lift_coupled<Sinh, Cosh>(u).first;
}

/// Range: all reals.
template <Series S>
S cosh(const S& u) {
  return lift_coupled<Sinh, Cosh>(u).second;
}

/// Range: all reals.
template <Series S>
S tanh(const S& u) {
  return lift_coupled<Tanh, HyperbolicSecantSquared>(u).first;
}

/// Range: all reals.
template <Series S>
S asinh(const S& u) {
  return lift<Asinh, S>(u, hypot(u, 1.0));
}

/// Range: u_0 > 1. At 1 coefficient 1 is the first that is not finite.
template <Series S>
S acosh(const S& u) {
  return lift<Acosh, S>(u, sqrt(u - 1.0) * sqrt(u + 1.0));
}

/// Range: |u_0| < 1. At +-1 coefficient 0 is not finite.
template <Series S>
S atanh(const S& u) {
  return lift<Atanh, S>(u, lift<OneMinusSquare, S>(u));
}

// ---- error functions -------------------------------------------------------------------------------------

/// Range: all reals.
template <Series S>
S erf(const S& u) {
  return lift<Erf, S>(u, lift<Gaussian, S>(u, square(u)));
}

/// 1 - erf(u), without cancellation at large u_0.   Range: all reals.
template <Series S>
S erfc(const S& u) {
  return lift<Erfc, S>(u, lift<Gaussian, S>(u, square(u)));
}

// ---- powers ----------------------------------------------------------------------------------------------

/// u^n for a whole number n, by repeated squaring: holds for any u_0 (n < 0: u_0 != 0; n > INT_MIN).
/// Cost: <= 2 log2 |n| products.
template <Series S>
S pow(const S& u, int n) {
  if (n < 0) return pow(1.0 / u, -n);
  if (n == 0) return S(1.0);
  if (n == 1) return u;
  const S squared = square(pow(u, n / 2));
  return n % 2 == 0 ? squared : squared * u;
}

/// u^a for a real number a; a whole number a is the product above.
/// Range: u_0 > 0, or a whole. At u_0 = 0 coefficient 1 is not finite.
template <Series S, std::floating_point A>
S pow(const S& u, A a) {
  if (a == std::trunc(a) && std::abs(a) <= 1024) return pow(u, static_cast<int>(a));
  return lift<Power, S>(a, u);
}

/// u^v = exp(v log(u)); a v without terms beyond the first is a number, as above.
/// Range: u_0 > 0. At u_0 = 0 coefficient 1 is not finite.
template <class J>
  requires is_jet<J>
J pow(const J& u, const J& v) {
  using T = typename J::value_type;
  if (v != J(v[0])) return lift<PowerOfSeries, J>(u, v, v * log(u));
  if constexpr (std::floating_point<T>)
    return pow(u, v[0]);
  else
    return lift<Power, J>(v[0], u);
}

/// c^v = exp(v log(c)) for a number c.   Range: c > 0.
template <Series S, ScalarOf<S> X>
S pow(const X& c, const S& v) {
  using std::log;
  using T = typename S::value_type;
  return lift<PowerOfSeries, S>(c, v, v * T(log(T(c))));
}

}  // namespace jetlag
