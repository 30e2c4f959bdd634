// SPDX-License-Identifier: MIT
#pragma once
// Jets in comparisons and choices: what a law writes instead of branches, for numbers and jets.
//
// A law that branches with `if` works on numbers and jets, but cannot be recorded on a tape. Written with
//
//   select(x < 0.0, a, b)      a where x_0 < 0, else b
//   abs(x), min(x, y), max(x, 0.0)
//
// it serves them all (tape/recording.hpp has the same names for recorded values).

#include <algorithm>
#include <cmath>
#include <compare>
#include <concepts>
#include <type_traits>

#include "jetlag/series/elementary.hpp"

namespace jetlag {

using std::abs, std::max, std::min;  // plain numbers

// ---- comparisons -----------------------------------------------------------------------------------------

/// < <= > >= of coefficient 0; == compares all coefficients. A NaN is neither below nor above.
template <class T, int N>
std::partial_ordering operator<=>(const Jet<T, N>& u, const Jet<T, N>& v) {
  if constexpr (is_jet<T>)
    return u[0] <=> v[0];
  else
    return u[0] < v[0]    ? std::partial_ordering::less
           : u[0] > v[0]  ? std::partial_ordering::greater
           : u[0] == v[0] ? std::partial_ordering::equivalent
                          : std::partial_ordering::unordered;
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
std::partial_ordering operator<=>(const Jet<T, N>& u, const X& c) {
  return u <=> Jet<T, N>(c);
}

/// a if the condition holds, else b. Both are computed; the one that is not selected may be NaN.
template <std::same_as<bool> Condition, class A, class B>
std::common_type_t<A, B> select(Condition condition, const A& a, const B& b) {
  if (condition) return a;
  return b;
}

// ---- choices by the sign near t = 0 ----------------------------------------------------------------------

/// |u|.   Range: u does not change its sign at t = 0; else the coefficients from the kink on are NaN (sign.hpp).
template <Series S>
S abs(const S& u) {
  return lift<Abs, S>(lift<Sign, S>(u), u);
}

/// The smaller of u, v near t = 0.   Range: as |u - v|.
template <class T, int N>
Jet<T, N> min(const Jet<T, N>& u, const Jet<T, N>& v) {
  return lift<BySign, Jet<T, N>>(lift<Sign, Jet<T, N>>(u - v), u, v);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> min(const Jet<T, N>& u, const X& c) {
  return min(u, Jet<T, N>(c));
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> min(const X& c, const Jet<T, N>& u) {
  return min(u, Jet<T, N>(c));
}

/// The larger of u, v near t = 0.   Range: as |u - v|.
template <class T, int N>
Jet<T, N> max(const Jet<T, N>& u, const Jet<T, N>& v) {
  return lift<BySign, Jet<T, N>>(lift<Sign, Jet<T, N>>(u - v), v, u);
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> max(const Jet<T, N>& u, const X& c) {
  return max(u, Jet<T, N>(c));
}
template <class T, int N, ScalarOf<Jet<T, N>> X>
Jet<T, N> max(const X& c, const Jet<T, N>& u) {
  return max(u, Jet<T, N>(c));
}

}  // namespace jetlag
