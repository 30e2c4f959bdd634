// SPDX-License-Identifier: MIT
#pragma once
// Functions that are made of several rules: where a checked jet has no series, the message names the function, not
// one of its rules. Included by elementary.hpp.

#include <algorithm>
#include <type_traits>

#include "jetlag/series/jet.hpp"

namespace jetlag {

namespace detail {

/// f(u...) computed by quiet jets, of what is known of u.... Those of run-time degree tell what does not exist (NaN)
/// from what is not known (a smaller degree).
template <class J, class F, class... U>
J checked(const char* name, F f, const U&... u) {
  using Quiet = Jet<typename J::value_type, Dynamic>;
  bool known = true;
  const auto quiet = [&]<class X>(const X& x) {
    if constexpr (std::is_same_v<X, J>) {
      Quiet q(x);
      known = known && known_degree(q) >= 0;
      if (known_degree(q) < q.degree()) q.resize(std::max(known_degree(q), 0));
      return q;
    } else {
      return x;
    }
  };
  const Quiet v = f(quiet(u)...);
  const int last = known_degree(v);
  if (known && last < v.degree()) throw SingularPoint(name, last + 1, describe<J>(u...));
  return J(v);
}

}  // namespace detail

template <class T, int N>
CheckedJet<T, N> asin(const CheckedJet<T, N>& u) {
  return detail::checked<CheckedJet<T, N>>("asin", [](const auto& x) { return asin(x); }, u);
}
template <class T, int N>
CheckedJet<T, N> acos(const CheckedJet<T, N>& u) {
  return detail::checked<CheckedJet<T, N>>("acos", [](const auto& x) { return acos(x); }, u);
}
template <class T, int N>
CheckedJet<T, N> acosh(const CheckedJet<T, N>& u) {
  return detail::checked<CheckedJet<T, N>>("acosh", [](const auto& x) { return acosh(x); }, u);
}
template <class T, int N>
CheckedJet<T, N> atanh(const CheckedJet<T, N>& u) {
  return detail::checked<CheckedJet<T, N>>("atanh", [](const auto& x) { return atanh(x); }, u);
}
template <class T, int N>
CheckedJet<T, N> hypot(const CheckedJet<T, N>& x, const CheckedJet<T, N>& y) {
  return detail::checked<CheckedJet<T, N>>(
      "hypot", [](const auto& a, const auto& b) { return hypot(a, b); }, x, y);
}
template <class T, int N>
CheckedJet<T, N> atan2(const CheckedJet<T, N>& y, const CheckedJet<T, N>& x) {
  return detail::checked<CheckedJet<T, N>>(
      "atan2", [](const auto& a, const auto& b) { return atan2(a, b); }, y, x);
}

}  // namespace jetlag
