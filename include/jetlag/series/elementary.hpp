// SPDX-License-Identifier: MIT
#pragma once
// The elementary functions, written once for everything that `lift` serves: jets, and the recording scalar
// of a tape (tape/recording.hpp).

#include <cmath>
#include <complex>
#include <concepts>
#include <cstdint>
#include <limits>

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
  return lift_coupled<Sin, Cos, S>(u).first;
}

/// Range: all reals.
template <Series S>
S cos(const S& u) {
  return lift_coupled<Sin, Cos, S>(u).second;
}

/// Range: u_0 is no odd multiple of pi/2.
template <Series S>
S tan(const S& u) {
  return lift_coupled<Tan, SecantSquared, S>(u).first;
}

namespace detail {
template <class S>
concept ComplexJet = is_jet<S> && is_complex<typename S::value_type>;

/// The square root c of a complex series, or -c: the branch whose coefficient 0 is value(u_0).
template <Series S, class F>
S on_branch(const S& c, const S& u, F value) {
  if constexpr (ComplexJet<S>)
    if (std::real(c[0] * std::conj(value(u[0]))) < 0) return -c;
  return c;
}

/// 1 + u^2
template <Series S>
S one_plus_square(const S& u) {
  if constexpr (ComplexJet<S>)  // (1 - i u)(1 + i u), which does not cancel
    return lift<OneMinusSquare, S>(typename S::value_type(0, 1) * u);
  else
    return 1.0 + square(u);
}
}  // namespace detail

/// Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
template <Series S>
S asin(const S& u) {
  const auto cosine = [](const auto& x) { return cos(asin(x)); };
  return lift<Asin, S>(u, detail::on_branch(sqrt(lift<OneMinusSquare, S>(u)), u, cosine));
}

/// Range: |u_0| < 1. At +-1 coefficient 1 is the first that is not finite.
template <Series S>
S acos(const S& u) {
  const auto sine = [](const auto& x) { return sin(acos(x)); };
  return lift<Acos, S>(u, detail::on_branch(sqrt(lift<OneMinusSquare, S>(u)), u, sine));
}

/// Range: all reals; beyond 1e154, the square of which overflows, coefficient 2 is not finite.
template <Series S>
S atan(const S& u) {
  return lift<Atan, S>(u, detail::one_plus_square(u));
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

/// sqrt(x^2 + y^2), without overflow.   Range: (x_0, y_0) != (0, 0). There a common power of t is taken out of jets, for
/// t >= 0: hypot(3 t, 4 t) = 5 t. In other series coefficient 1 is the first that is not finite.
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

/// tr U and the second invariant of the stretch U = R^T F of a matrix F with I = tr F^T F, II = tr cof F^T F, J = det F.
/// Range: no two principal stretches add up to zero. There coefficient 0 of the second, 1 of the first is not finite.
template <Series S>
std::pair<S, S> stretch_invariants(const S& i, const S& ii, const S& j) {
  return lift_coupled<FirstStretchInvariant, SecondStretchInvariant, S>(i, ii, j);
}

// ---- hyperbolic functions and their inverses -------------------------------------------------------------

/// Range: all reals.
template <Series S>
S sinh(const S& u) {
  return lift_coupled<Sinh, Cosh, S>(u).first;
}

/// Range: all reals.
template <Series S>
S cosh(const S& u) {
  return lift_coupled<Sinh, Cosh, S>(u).second;
}

/// Range: all reals.
template <Series S>
S tanh(const S& u) {
  return lift_coupled<Tanh, HyperbolicSecantSquared, S>(u).first;
}

/// Range: all reals.
template <Series S>
S asinh(const S& u) {
  if constexpr (detail::ComplexJet<S>) {
    const auto cosine = [](const auto& x) { return cosh(asinh(x)); };
    return lift<Asinh, S>(u, detail::on_branch(sqrt(detail::one_plus_square(u)), u, cosine));
  } else {
    return lift<Asinh, S>(u, hypot(u, 1.0));
  }
}

/// Range: u_0 > 1. At 1 coefficient 1 is the first that is not finite.
template <Series S>
S acosh(const S& u) {
  const auto sine = [](const auto& x) { return sinh(acosh(x)); };
  return lift<Acosh, S>(u, detail::on_branch(S(sqrt(u - 1.0) * sqrt(u + 1.0)), u, sine));
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

namespace detail {
template <class S>
inline constexpr bool is_jet_of_floating_point = false;
template <class T, int N, Singularities P>
inline constexpr bool is_jet_of_floating_point<Jet<T, N, P>> = std::floating_point<T>;

/// u^n by repeated squaring.
template <Series S>
S product_of(const S& u, std::uint64_t n) {
  if (n == 0) return S(1.0);
  if (n == 1) return u;
  const S squared = square(product_of(u, n / 2));
  return n % 2 == 0 ? squared : squared * u;
}
}  // namespace detail

/// u^n for a whole number n of any type, by repeated squaring: holds for any u_0 (n < 0: u_0 != 0).
/// Cost: <= 2 log2 |n| products. Beyond |n| = 1024, where their rounding adds up, by the rule of real powers if u_0 != 0.
template <Series S, std::integral N>
S pow(const S& u, N n) {
  if constexpr (detail::is_jet_of_floating_point<S>) {
    using T = typename S::value_type;
    constexpr T largest =
        2 / std::numeric_limits<T>::epsilon();  // whole numbers up to here are numbers of type T
    const T a = static_cast<T>(n);
    if (std::abs(a) > 1024 && std::abs(a) <= largest && u[0] != 0) return lift<Power, S>(a, u);
  }
  if constexpr (std::signed_integral<N>)
    if (n < 0) return detail::product_of(S(1.0 / u), -static_cast<std::uint64_t>(n));
  return detail::product_of(u, static_cast<std::uint64_t>(n));
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
  else if (const auto a = detail::exact_double(v[0]); a && *a == std::trunc(*a) && std::abs(*a) <= 1024)
    return pow(u, static_cast<int>(*a));
  else
    return lift<Power, J>(v[0], u);
}

/// u^z for a complex number z.   Range: u_0 != 0, or z whole.
template <class J>
  requires is_jet<J> && is_complex<typename J::value_type>
J pow(const J& u, const typename J::value_type& z) {
  return pow(u, J(z));
}

/// c^v = exp(v log(c)) for a number c.   Range: c > 0; any c if v has no terms beyond the first and c^(v_0) exists.
template <Series S, ScalarOf<S> X>
S pow(const X& c, const S& v) {
  using std::log, std::pow;
  using T = typename S::value_type;
  if (v == S(v[0])) {
    S p = v;
    p[0] = T(pow(T(c), v[0]));
    if (detail::is_finite(p[0])) return p;
    p[0] = T(c);  // c as a series
    return pow(p, v);
  }
  return lift<PowerOfSeries, S>(c, v, v * T(log(T(c))));
}

// ---- complex numbers -------------------------------------------------------------------------------------
//
// Jet<std::complex<double>, N> is the series of an analytic function: the functions above that std::complex has, with
// its branches. On a branch cut the series is that of the branch which the value is on.

namespace detail {
template <class Y, class T, int N, Singularities P, class F>
Jet<Y, N, P> mapped(const Jet<T, N, P>& u, F f) {
  auto v = zeros<Jet<Y, N, P>>(degree_of(u));
  for (int k = 0; k <= u.degree(); ++k) v[k] = f(u[k]);
  return v;
}
}  // namespace detail

/// The real and imaginary parts for real t, and the conjugate.
template <class T, int N, Singularities P>
Jet<T, N, P> real(const Jet<std::complex<T>, N, P>& u) {
  return detail::mapped<T>(u, [](const std::complex<T>& z) { return z.real(); });
}
template <class T, int N, Singularities P>
Jet<T, N, P> imag(const Jet<std::complex<T>, N, P>& u) {
  return detail::mapped<T>(u, [](const std::complex<T>& z) { return z.imag(); });
}
template <class T, int N, Singularities P>
Jet<std::complex<T>, N, P> conj(const Jet<std::complex<T>, N, P>& u) {
  return detail::mapped<std::complex<T>>(u, [](const std::complex<T>& z) { return std::conj(z); });
}

// Not analytic. clang-format off
template <class T, int N, Singularities P>
void abs(const Jet<std::complex<T>, N, P>&) =
    delete;  // not analytic: for real t write hypot(real(u), imag(u))
template <class T, int N, Singularities P>
void arg(const Jet<std::complex<T>, N, P>&) =
    delete;  // not analytic: for real t write atan2(imag(u), real(u))
template <class T, int N, Singularities P>
void norm(const Jet<std::complex<T>, N, P>&) =
    delete;  // not analytic: for real t write square(real(u)) + square(imag(u))
// clang-format on

}  // namespace jetlag
