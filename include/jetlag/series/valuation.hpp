// SPDX-License-Identifier: MIT
#pragma once
// Common powers of t: what a function does where its argument vanishes, u = t^l g with g_0 != 0.
//
//   t / (t + t^2)       = 1 / (1 + t)          sqrt(t^2 + t^3)   = t sqrt(1 + t)
//   (t^4 + t^5)^1.5     = t^6 (1 + t)^1.5      cbrt(t^3 + t^4)   = t cbrt(1 + t)
//   hypot(3 t, 4 t)     = 5 t                  atan2(t^2, t)     = atan2(t, 1)
//
// A rule R that is homogeneous of degree a gives t^(l a) R(g). If l a is a whole number >= 0 this is a series, of
// which coefficients 0 .. l a + K - l are known when K + 1 of u are. If not, the coefficients below l a are 0 and
// the one at the next whole number does not exist: t^1.5 = (0, 0, inf). Where sqrt, pow, hypot and atan2 see an odd
// power of t become common (t = |t| for t > 0 only), the series is that for t >= 0, as is sqrt(t^2) = t.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "jetlag/series/coefficients.hpp"
#include "jetlag/series/singular_point.hpp"

namespace jetlag {

struct Divide;
struct Sqrt;
struct Cbrt;
struct Power;

/// Smallest k with u_k != 0; for the zero series one more than its degree.
template <class T, int N, Singularities P>
int valuation(const Jet<T, N, P>& u) {
  int k = 0;
  while (k <= u.degree() && u[k] == T(0)) ++k;
  return k;
}

/// The highest K such that coefficients 0 .. K are finite; -1 if there is none.
template <class T, int N, Singularities P>
int known_degree(const Jet<T, N, P>& u) {
  int k = 0;
  while (k <= u.degree() && detail::is_finite(u[k])) ++k;
  return k - 1;
}

namespace detail {

/// A coefficient of order N > 0 that says of a series without others: above 0, but what it is lies beyond t^N. The
/// smallest number above numeric_limits<Jet>::min(), twice; 0 for a type without a smallest one.
template <class T>
T beyond_what_is_known() {
  return std::numeric_limits<T>::min() + std::numeric_limits<T>::min();
}

/// l a, the power of t that comes out of a function.
struct PowerOfT {
  int order;  // l a; if that is no whole number >= 0, the order of the first coefficient that does not exist
  bool whole;
};

constexpr PowerOfT fraction(int l, int divisor) { return {(l + divisor - 1) / divisor, l % divisor == 0}; }

/// l a without rounding, so that whole means whole. Where only the rounded product is whole (3 times the double next
/// to 1/3), no coefficient of that order or above it is claimed.
inline PowerOfT multiple(int l, double a) {
  if (!(a >= 0)) return {0, false};
  const double product = l * a, order = std::min(std::ceil(product), 0x1p30);
  return {static_cast<int>(order), order == product && std::fma(l, a, -product) == 0};
}

/// x as a double, if it is one.
template <class T>
std::optional<double> exact_double(const T& x) {
  if constexpr (is_jet<T>) {
    for (int k = 1; k <= x.degree(); ++k)
      if (x[k] != typename T::value_type(0)) return {};
    return exact_double(x[0]);
  } else if constexpr (is_complex<T>) {
    if (x.imag() == 0) return exact_double(x.real());
  } else if constexpr (requires { static_cast<double>(x); }) {
    const auto y = static_cast<double>(x);
    if (T(y) == x) return y;
  }
  return {};
}

/// Homogeneous rules: R(t^l u, t^l v) = t^(l a) R(u, v). `power` gives l a; nothing if it cannot be told.
template <class R>
struct Homogeneity {
  static constexpr bool holds = false;
};
template <>
struct Homogeneity<Divide> {
  static constexpr bool holds = true;
  static std::optional<PowerOfT> power(int, const auto&...) { return PowerOfT{0, true}; }
};
template <>
struct Homogeneity<Sqrt> {
  static constexpr bool holds = true;
  static std::optional<PowerOfT> power(int l, const auto&...) { return fraction(l, 2); }
};
template <>
struct Homogeneity<Cbrt> {
  static constexpr bool holds = true;
  static std::optional<PowerOfT> power(int l, const auto&...) { return fraction(l, 3); }
};
template <>
struct Homogeneity<Power> {
  static constexpr bool holds = true;
  static std::optional<PowerOfT> power(int l, const auto& a, const auto&) {
    const auto exponent = exact_double(a);
    return exponent ? std::optional(multiple(l, *exponent)) : std::nullopt;
  }
};

}  // namespace detail
}  // namespace jetlag
