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
#include <concepts>
#include <type_traits>

#include "jetlag/series/elementary.hpp"

namespace jetlag {

using std::abs, std::max, std::min;  // plain numbers

// ---- comparisons: < <= > >= of jets are those for small t > 0 (jet.hpp) -------------------------------------

/// a if the condition holds, else b. Both are computed; the one that is not selected may be NaN.
template <std::same_as<bool> Condition, class A, class B>
std::common_type_t<A, B> select(Condition condition, const A& a, const B& b) {
  if (condition) return a;
  return b;
}

// ---- choices by the sign right after t = 0 ----------------------------------------------------------------------

/// |u|, at a change of its sign the series of the right half, t >= 0 (sign.hpp).
template <Series S>
S abs(const S& u) {
  return lift<Abs, S>(lift<Sign, S>(u), u);
}
template <class T, int N>
CheckedJet<T, N> abs(const CheckedJet<T, N>& u) {
  return detail::checked<CheckedJet<T, N>>("abs", [](const auto& x) { return abs(x); }, u);
}

/// The smaller of u, v right after t = 0.
template <Series S>
S min(const S& u, const S& v) {
  return lift<BySign, S>(lift<Sign, S>(u - v), u, v);
}
template <class T, int N>
CheckedJet<T, N> min(const CheckedJet<T, N>& u, const CheckedJet<T, N>& v) {
  return detail::checked<CheckedJet<T, N>>(
      "min", [](const auto& a, const auto& b) { return min(a, b); }, u, v);
}
template <Series S, ScalarOf<S> X>
S min(const S& u, const X& c) {
  return min(u, S(c));
}
template <Series S, ScalarOf<S> X>
S min(const X& c, const S& u) {
  return min(u, S(c));
}

/// The larger of u, v right after t = 0.
template <Series S>
S max(const S& u, const S& v) {
  return lift<BySign, S>(lift<Sign, S>(u - v), v, u);
}
template <class T, int N>
CheckedJet<T, N> max(const CheckedJet<T, N>& u, const CheckedJet<T, N>& v) {
  return detail::checked<CheckedJet<T, N>>(
      "max", [](const auto& a, const auto& b) { return max(a, b); }, u, v);
}
template <Series S, ScalarOf<S> X>
S max(const S& u, const X& c) {
  return max(u, S(c));
}
template <Series S, ScalarOf<S> X>
S max(const X& c, const S& u) {
  return max(u, S(c));
}

}  // namespace jetlag
