// SPDX-License-Identifier: MIT
#pragma once
// When a cubic polynomial leaves a band about zero.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace jetlag {

using Cubic = std::array<double, 4>;  // c[k] s^k

inline double horner(const Cubic& c, double s) { return ((c[3] * s + c[2]) * s + c[1]) * s + c[0]; }

namespace detail {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// The first s >= 0 at which c2 s^2 + c1 s + c0 rises to zero; c0 <= 0. The root is written without cancellation.
inline double rises_to_zero(double c0, double c1, double c2) {
  if (c2 <= 0 && c1 <= 0) return never;
  const double square = c1 * c1 - 4 * c2 * c0;
  if (square < 0) return never;  // it turns before
  const double root = std::sqrt(square);
  return c1 > 0 ? -2 * c0 / (c1 + root) : (root - c1) / (2 * c2);
}

/// The zero of c in (a, b], c(a) <= 0 <= c(b), c monotone: Newton's method where it stays inside, else bisection.
inline double zero_between(const Cubic& c, double a, double b) {
  double s = b;
  for (int i = 0; i < 200; ++i) {
    const double value = horner(c, s);
    (value < 0 ? a : b) = s;
    const double next = s - value / ((3 * c[3] * s + 2 * c[2]) * s + c[1]);
    s = next > a && next < b ? next : a + (b - a) / 2;
    if (!(s > a && s < b) || value == 0) break;
  }
  return b;
}

/// As above for a cubic: between its extrema, and where it rises for ever between the last of them and Fujiwara's bound
///     2 max(|c2/c3|, |c1/c3|^(1/2), |c0/c3|^(1/3))
/// on all its roots.
inline double rises_to_zero(const Cubic& c) {
  const double bound = 2 * std::max({std::abs(c[2] / c[3]), std::sqrt(std::abs(c[1] / c[3])),
                                     std::cbrt(std::abs(c[0] / c[3]))});
  if (!(bound < never)) return rises_to_zero(c[0], c[1], c[2]);  // s^3 does not count
  std::array<double, 2> extrema{0.0, 0.0};
  if (const double square = c[2] * c[2] - 3 * c[3] * c[1]; square > 0) {
    const double q = -(c[2] + std::copysign(std::sqrt(square), c[2]));
    extrema = {q / (3 * c[3]), c[1] / q};
    if (extrema[0] > extrema[1]) std::swap(extrema[0], extrema[1]);
  }
  double from = 0;
  if (c[0] == 0 && (c[1] > 0 || (c[1] == 0 && (c[2] > 0 || (c[2] == 0 && c[3] > 0))))) return 0;
  for (const double to : extrema) {
    if (!(to > from)) continue;
    const double value = horner(c, to);
    if (value >= 0 && value > horner(c, from)) return zero_between(c, from, to);
    from = to;
  }
  return c[3] > 0 ? zero_between(c, from, std::max(bound, std::nextafter(from, never))) : never;
}

inline double first_rise(Cubic c, double level) {
  c[0] = std::min(c[0] - level, 0.0);  // it may have been rounded out of the band
  return c[3] == 0 ? rises_to_zero(c[0], c[1], c[2]) : rises_to_zero(c);
}

}  // namespace detail

/// The first s >= 0 at which |c(s)| reaches `width` on its way out, |c(0)| <= width but for rounding; infinite where it
/// never does. NaN or nonsense for coefficients that are not finite.
inline double first_departure(const Cubic& c, double width) {
  return std::min(detail::first_rise(c, width), detail::first_rise({-c[0], -c[1], -c[2], -c[3]}, width));
}

}  // namespace jetlag
