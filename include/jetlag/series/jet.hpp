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
// Jet<T, Dynamic> has its degree at run time. An operation on two of them knows as many coefficients as both do;
// a plain number has all coefficients and adapts:
//
//   auto x = Jet<double, Dynamic>::variable(2.0, 3);        //  2 + t + O(t^4)
//   auto y = exp(x) * 2.0;                                  //  y.degree() == 3
//   x.append(0.0);                                          //  one more coefficient is known
//
// Where a function is not analytic at the point (sqrt at 0, division by 0) the jet is not finite from the
// first coefficient that does not exist; a CheckedJet throws (singular_point.hpp). Where the singularity is
// removable (t/t) the common power of t is cancelled (valuation.hpp); the top coefficients, which the known ones do
// not determine, are then NaN, and a dynamic jet is of smaller degree. At a kink (abs, min, max, hypot at 0) and in
// comparisons a jet is taken for small t > 0: abs(-t) = t.
//
// T is any number type with + - * / and, for the functions used, sqrt, exp, ... found by argument-dependent
// lookup; its operators must return T (Boost.Multiprecision: et_off). A jet is such a type: Jet<Jet<double, 1>, 20>
// is a series in t with its derivative by a parameter.

#include <algorithm>
#include <cassert>
#include <compare>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <span>
#include <type_traits>

#include "jetlag/series/calculus/polynomial.hpp"
#include "jetlag/series/coefficients.hpp"
#include "jetlag/series/lift.hpp"
#include "jetlag/series/operators.hpp"
#include "jetlag/series/singular_point.hpp"

namespace jetlag {

namespace detail {
template <class T>
concept Ordered = is_jet<T> || requires(const T& a) { a < a; };

template <class T>
std::partial_ordering order_of(const T& a, const T& b) {
  if constexpr (is_jet<T>)
    return a <=> b;
  else
    return a < b    ? std::partial_ordering::less
           : a > b  ? std::partial_ordering::greater
           : a == b ? std::partial_ordering::equivalent
                    : std::partial_ordering::unordered;
}
}  // namespace detail

/// A jet; P: what it does at a singular point.
template <class T, int N, Singularities P>
class Jet : public detail::Coefficients<T, N>, SeriesOperators<Jet<T, N, P>> {
  using detail::Coefficients<T, N>::c_;

 public:
  using value_type = T;
  static constexpr int degree_at_compile_time = N;
  static constexpr Singularities singularities = P;
  using detail::Coefficients<T, N>::degree;  // J::degree of a static jet, u.degree() of any

  Jet() = default;  // the constant 0

  /// The constant series x.
  template <class X>
    requires std::convertible_to<X, T>
  Jet(const X& x) {  // implicit: numbers are jets
    c_[0] = T(x);
  }

  /// The same series in another degree or policy. Coefficients that u does not know are NaN.
  template <int M, Singularities Q>
    requires(M != N || Q != P)
  explicit Jet(const Jet<T, M, Q>& u) {
    if constexpr (N == Dynamic)
      if (!u.is_constant()) this->resize(u.degree());
    for (int k = 0; k <= degree(); ++k)
      c_[k] = k <= u.degree() ? u[k] : u.is_constant() ? T(0) : detail::not_a_number<T>();
  }

  /// From coefficients u_0, u_1, ...; at least one is given. In a static jet the missing ones are 0 and at most
  /// N + 1 are given.
  static Jet from(std::span<const T> coefficients) {
    const int given = static_cast<int>(coefficients.size());
    assert(given > 0);
    Jet u;
    if constexpr (N == Dynamic) u.resize(given - 1);
    assert(given <= u.degree() + 1);
    for (int k = 0; k < given; ++k) u.c_[k] = coefficients[k];
    return u;
  }
  static Jet from(std::initializer_list<T> coefficients) {
    return from(std::span<const T>(coefficients.begin(), coefficients.size()));
  }

  /// x + t.
  static Jet variable(const T& x)
    requires(N != Dynamic)
  {
    Jet u(x);
    if constexpr (N >= 1) u.c_[1] = T(1);
    return u;
  }
  /// x + t, known to a degree >= 0.
  static Jet variable(const T& x, int degree)
    requires(N == Dynamic)
  {
    Jet u(x);
    u.resize(degree);
    if (degree >= 1) u.c_[1] = T(1);
    return u;
  }

  /// u(t), by Horner's rule. Also for another type X of argument, such as a jet (composition); the result is of
  /// the wider type, as it is for a product.
  template <class X>
    requires requires(const T& c, const X& t) { c* t + c; }
  auto operator()(const X& t) const {
    using Value = std::decay_t<decltype(c_[0] * t + c_[0])>;
    return evaluate<Value>(c_, Value(t));
  }

  /// All coefficients are equal, and as many are known.
  friend bool operator==(const Jet& u, const Jet& v) {
    if constexpr (N != Dynamic) {
      return u.c_ == v.c_;
    } else {
      if (!u.is_constant() && !v.is_constant()) return u.c_ == v.c_;
      for (int k = 0; k <= u.degree() || k <= v.degree(); ++k)
        if (!(u[k] == v[k])) return false;
      return true;
    }
  }

  /// < <= > >= by the first coefficient in which u and v differ: the order of u(t) and v(t) for small t > 0. What
  /// only one of them knows is not compared. A NaN that is met is neither below nor above.
  friend std::partial_ordering operator<=>(const Jet& u, const Jet& v)
    requires detail::Ordered<T>
  {
    const int known_of_u = detail::degree_of(u), known_of_v = detail::degree_of(v);
    const int last = std::min({known_of_u, known_of_v, std::max(u.degree(), v.degree())});
    for (int k = 0; k <= last; ++k)
      if (const auto order = detail::order_of(u[k], v[k]); order != 0) return order;
    return std::partial_ordering::equivalent;
  }
};

/// A jet that throws SingularPoint where a function has no Taylor series.
template <class T, int N>
using CheckedJet = Jet<T, N, Singularities::checked>;

/// Whether all coefficients are finite.
template <class T, int N, Singularities P>
bool isfinite(const Jet<T, N, P>& u) {
  return known_degree(u) == u.degree();
}

/// Whether a coefficient is NaN.
template <class T, int N, Singularities P>
bool isnan(const Jet<T, N, P>& u) {
  return !(u == u);
}

/// Whether a coefficient is infinite and none is NaN.
template <class T, int N, Singularities P>
bool isinf(const Jet<T, N, P>& u) {
  return !isnan(u) && !isfinite(u);
}

// ---- calculus --------------------------------------------------------------------------------------------

/// u'. In a static jet coefficient N is not determined by u and is set to 0: the derivative of the polynomial. A
/// dynamic jet has one degree less; of degree 0, whose derivative is not known at all, it becomes NaN.
template <class T, int N, Singularities P>
Jet<T, N, P> derivative(const Jet<T, N, P>& u) {
  if (u.is_constant()) return T(0);
  auto v = detail::zeros<Jet<T, N, P>>(u.degree() > 0 ? u.degree() - 1 : 0);
  for (int k = 0; k < u.degree(); ++k) v[k] = (k + 1) * u[k + 1];
  if (N == Dynamic && u.degree() == 0) v[0] = detail::not_a_number<T>();
  return v;
}

/// The integral of u from 0 to t, plus c. A static jet drops coefficient N of u; a dynamic jet has one degree more.
template <class T, int N, Singularities P>
Jet<T, N, P> integral(const Jet<T, N, P>& u, const std::type_identity_t<T>& c = T(0)) {
  auto v = detail::zeros<Jet<T, N, P>>(u.degree() + 1);
  v[0] = c;
  for (int k = 1; k <= v.degree(); ++k) v[k] = u[k - 1] / T(k);
  return v;
}

/// The polynomial u about a new origin: v(t) = u(s + t).
template <class T, int N, Singularities P>
Jet<T, N, P> shift_origin(const Jet<T, N, P>& u, const std::type_identity_t<T>& s) {
  auto c = u.coefficients();
  taylor_shift(c, s);
  auto v = u;
  for (int k = 0; k <= u.degree(); ++k) v[k] = c[k];
  return v;
}

}  // namespace jetlag

/// The limits of T, as constants. But for the smallest numbers > 0: in the order of jets those are multiples of the
/// highest power of t; of run-time degree there is none, and they are 0.
template <class T, int N, jetlag::Singularities P>
class std::numeric_limits<jetlag::Jet<T, N, P>> : public std::numeric_limits<T> {
  using Jet = jetlag::Jet<T, N, P>;
  using Limits = std::numeric_limits<T>;

  static Jet at_highest_power(const T& x) {
    Jet u;
    if constexpr (N != jetlag::Dynamic) u[N] = x;
    return u;
  }

 public:
  static Jet min() { return at_highest_power(Limits::min()); }
  static Jet denorm_min() { return at_highest_power(Limits::denorm_min()); }
  static Jet max() { return Limits::max(); }
  static Jet lowest() { return Limits::lowest(); }
  static Jet epsilon() { return Limits::epsilon(); }
  static Jet round_error() { return Limits::round_error(); }
  static Jet infinity() { return Limits::infinity(); }
  static Jet quiet_NaN() { return Limits::quiet_NaN(); }
  static Jet signaling_NaN() { return Limits::signaling_NaN(); }
};
