// SPDX-License-Identifier: MIT
#pragma once
// The elementary functions, written once for everything that `lift` serves: jets, and the recording scalar
// of a tape (tape/recording.hpp).

#include <cmath>
#include <concepts>

#include "jetlag/series/functions.hpp"
#include "jetlag/series/jet.hpp"

namespace jetlag {

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

/// Range: all reals.
template <Series S>
S exp(const S& u) {
  return lift<Exp, S>(u);
}

/// Range: u_0 > 0. At u_0 = 0 coefficient 0 is not finite.
template <Series S>
S log(const S& u) {
  return lift<Log, S>(u);
}

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

/// u^n for a whole number n, by repeated squaring: holds for any u_0 (n < 0: u_0 != 0; n > INT_MIN).   Cost: <= 2 log2 |n| products.
template <Series S>
S pow(const S& u, int n) {
  if (n < 0) return 1.0 / pow(u, -n);
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
/// Range: u_0 > 0. At u_0 = 0 coefficient 0 is not finite.
template <class T, int N, Singularities P>
Jet<T, N, P> pow(const Jet<T, N, P>& u, const Jet<T, N, P>& v) {
  if (v != Jet<T, N, P>(v[0])) return exp(v * log(u));
  if constexpr (std::floating_point<T>)
    return pow(u, v[0]);
  else
    return lift<Power, Jet<T, N, P>>(v[0], u);
}

}  // namespace jetlag
