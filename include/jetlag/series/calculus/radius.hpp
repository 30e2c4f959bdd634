// SPDX-License-Identifier: MIT
#pragma once
// How far a series reaches, judged from its coefficients u_0, ..., u_N: the radius of convergence R, which is the
// distance to the nearest singularity in the complex plane, and what the terms beyond u_N would add.
//
// Finitely many coefficients prove nothing. These are estimates, each made for one kind of nearest singularity:
//
//   estimate                 one, real                a pair +-R or +-iR    several, or a pair off the axes
//   radius_by_ratio          error |a-1|/N            as one real           useless
//   radius_by_root           error O(ln N / N)        as one real           as one real
//   radius_by_last_two       error O(ln N / N)        as one real           as one real
//   radius_by_three_terms    0 for (1 - t/R)^{-a}     as one real           useless
//
// (errors relative to R, for u like (1 - t/R)^{-a}). A series that has ended, its last two coefficients are 0, has the
// radius infinity; so has an entire function where the estimate can see it, otherwise it has one that grows with N. A
// series with a coefficient that is not finite has the radius 0. The result is never NaN. Coefficients may be of any
// size that T can hold: ratios and roots are taken by logarithms. For containers with size() and [], and for jets.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/polynomial.hpp"

namespace jetlag {

namespace detail {

template <class S>
using ValueOf = std::decay_t<decltype(coefficients_of(std::declval<const S&>())[0])>;

template <class T>
T infinite() {
  return T(std::numeric_limits<double>::infinity());
}

template <class T>
T size_of(const T& x) {
  return x < T(0) ? T(-x) : x;
}

/// (|a| / |b|)^{1/distance}, b != 0.
template <class T>
T root_of_ratio(const T& a, const T& b, std::size_t distance) {
  using std::exp, std::log;
  return exp(T((log(size_of(a)) - log(size_of(b))) / static_cast<int>(distance)));
}

template <class C>
bool all_finite(const C& u) {
  for (std::size_t n = 0; n < u.size(); ++n)
    if (!(u[n] - u[n] == ValueOf<C>(0))) return false;
  return true;
}

/// No more terms are to be expected: the last two coefficients are 0.
template <class C>
bool has_ended(const C& u) {
  const std::size_t size = u.size();
  return size < 2 || (u[size - 1] == ValueOf<C>(0) && u[size - 2] == ValueOf<C>(0));
}

/// The largest n < end with u_n != 0; u.size() where there is none.
template <class C>
std::size_t last_not_zero(const C& u, std::size_t end) {
  while (end-- > 0)
    if (!(u[end] == ValueOf<C>(0))) return end;
  return u.size();
}

/// min over n = first, ..., N of (|scale| / |u_n|)^{1/(n - origin)}; infinity where all u_n are 0.
template <class C, class T>
T smallest_root(const C& u, const T& scale, std::size_t origin, std::size_t first) {
  T radius = infinite<T>();
  for (std::size_t n = first; n < u.size(); ++n)
    if (!(u[n] == T(0))) radius = std::min(radius, root_of_ratio(scale, T(u[n]), n - origin));
  return radius;
}

}  // namespace detail

/// R = (|u_m| / |u_n|)^{1/(n-m)}, u_n and u_m the last two coefficients that are not 0.         Source: d'Alembert.
/// Exact for geometric series, in t or in t^2. For (1 - t/R)^{-a} it is R N / (N + a - 1), for exp it is N.
template <class S>
detail::ValueOf<S> radius_by_ratio(const S& series) {
  using T = detail::ValueOf<S>;
  const auto& u = coefficients_of(series);
  if (!detail::all_finite(u)) return T(0);
  if (detail::has_ended(u)) return detail::infinite<T>();
  const std::size_t n = detail::last_not_zero(u, u.size()), m = detail::last_not_zero(u, n);
  if (m == u.size()) return detail::infinite<T>();  // a single power of t
  return detail::root_of_ratio(T(u[m]), T(u[n]), n - m);
}

/// R = min over the later half of the n of (|u_l| / |u_n|)^{1/(n-l)}, u_l the first coefficient that is not 0, so that
/// the unit of u does not matter.         Source: Cauchy, Hadamard: 1/R = limsup |u_n|^{1/n}.
/// For |u_n| = c n^{a-1} R^-n the factor (|u_l|/c)^{1/n} n^{(1-a)/n} remains. For exp it is about N/e.
template <class S>
detail::ValueOf<S> radius_by_root(const S& series) {
  using T = detail::ValueOf<S>;
  const auto& u = coefficients_of(series);
  if (!detail::all_finite(u)) return T(0);
  if (detail::has_ended(u)) return detail::infinite<T>();
  std::size_t l = 0;
  while (u[l] == T(0)) ++l;
  return detail::smallest_root(u, T(u[l]), l, std::max(l + 1, u.size() / 2));
}

/// R = min((s / |u_{N-1}|)^{1/(N-1)}, (s / |u_N|)^{1/N}): the radius behind the step of Jorba and Zou, blind to the
/// zeros of even and odd functions.         Source: [JZ05] 3.2.
/// s > 0: the size that the series is measured by, such as |u_0| or, for absolute errors, 1. A factor f in s is a
/// factor f^{1/N} in R. For |u_n| = c n^{a-1} R^-n the factor (s/c)^{1/N} N^{(1-a)/N} remains.
template <class S>
detail::ValueOf<S> radius_by_last_two(const S& series, const detail::ValueOf<S>& scale) {
  using T = detail::ValueOf<S>;
  const auto& u = coefficients_of(series);
  if (!detail::all_finite(u)) return T(0);
  if (detail::has_ended(u)) return detail::infinite<T>();
  return detail::smallest_root(u, scale, 0, std::max<std::size_t>(u.size() - 2, 1));
}

/// 1/R = |n r_n - (n-1) r_{n-1}|,   r_n = u_n / u_{n-1}.         Source: Chang, Corliss, ACM TOMS 8 (1982), 3.1.
/// Exact for (1 - t/R)^{-a} with any a, where n r_n = (n + a - 1)/R, and for its logarithm. Of series in t^2, even or
/// odd, the same in t^2. Where the difference is within its rounding error, as for exp, R is infinity.
/// Read n as the count of powers, the last three coefficients that are not 0 being of powers n d, (n-1) d, (n-2) d
/// beyond t^c, c < d. Where there are no such three, it is the ratio rule.
template <class S>
detail::ValueOf<S> radius_by_three_terms(const S& series) {
  using T = detail::ValueOf<S>;
  const auto& u = coefficients_of(series);
  if (!detail::all_finite(u)) return T(0);
  if (detail::has_ended(u)) return detail::infinite<T>();
  const std::size_t size = u.size(), last = detail::last_not_zero(u, size);
  const std::size_t middle = detail::last_not_zero(u, last);
  const std::size_t first = middle == size ? size : detail::last_not_zero(u, middle);
  if (first == size || last - middle != middle - first) return radius_by_ratio(series);
  const std::size_t d = last - middle;
  const int n = static_cast<int>(last / d);
  const T newer = T(n * (u[last] / u[middle])), older = T((n - 1) * (u[middle] / u[first]));
  const T difference = detail::size_of(T(newer - older));
  const T rounding =
      T(4 * std::numeric_limits<T>::epsilon() * (detail::size_of(newer) + detail::size_of(older)));
  if (difference <= rounding) return detail::infinite<T>();
  return detail::root_of_ratio(T(1), difference, d);
}

/// What the terms beyond u_N add at |t| = h, bounded by a geometric series:
///   |sum_{n>N} u_n h^n| <= M (h/R)^{N+1} / (1 - h/R),   M = max_{N/2<=n<=N} |u_n| R^n.
/// A bound where |u_n| R^n <= M for all n > N too, such as where |u_n| R^n falls, otherwise an estimate: R a little too
/// large lets it fail near h = R. h >= 0; it is infinity from h = R on. radius: R > 0, finite unless the series has
/// ended (then the bound is 0); std::invalid_argument otherwise.
template <class S>
detail::ValueOf<S> tail_bound(const S& series, const detail::ValueOf<S>& h,
                              const detail::ValueOf<S>& radius) {
  using T = detail::ValueOf<S>;
  using std::exp, std::log;
  const auto& u = coefficients_of(series);
  if (!(h >= T(0))) throw std::invalid_argument("tail_bound: h must be >= 0, got " + shown(h));
  if (!(radius > T(0))) throw std::invalid_argument("tail_bound: radius must be > 0, got " + shown(radius));
  if (radius == detail::infinite<T>()) {
    if (detail::has_ended(u)) return T(0);
    throw std::invalid_argument(
        "tail_bound: radius must be finite for a series that has not ended, got infinity");
  }
  if (h >= radius) return detail::infinite<T>();
  if (h == T(0)) return T(0);
  const T log_ratio = log(T(h / radius));
  T largest(0);  // of |u_n| R^n (h/R)^{N+1}
  for (std::size_t n = u.size() / 2; n < u.size(); ++n)
    if (!(u[n] == T(0)))
      largest = std::max(largest, T(exp(T(log(detail::size_of(T(u[n]))) + static_cast<int>(n) * log(radius) +
                                          static_cast<int>(u.size()) * log_ratio))));
  return largest / (1 - h / radius);
}

}  // namespace jetlag
