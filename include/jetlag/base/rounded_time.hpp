// SPDX-License-Identifier: MIT
#pragma once
// Sums and differences of times, rounded to the side that is asked for.

#include <cmath>
#include <limits>

namespace jetlag {

/// The first double t with begin + s <= t in exact arithmetic; s >= 0, begin + s finite.
inline double time_after(double begin, double s) {
  const double t = begin + s, part = t - begin;
  const double left_out = (begin - (t - part)) + (s - part);  // two-sum (Knuth): begin + s = t + left_out
  return left_out > 0 ? std::nextafter(t, std::numeric_limits<double>::infinity()) : t;
}

/// The largest double s with begin + s <= end in exact arithmetic; begin <= end.
inline double time_between(double begin, double end) {
  const double s = end - begin, part = s - end;
  const double left_out = (end - (s - part)) - (begin + part);  // two-sum: end - begin = s + left_out
  return left_out < 0 ? std::nextafter(s, 0.0) : s;
}

}  // namespace jetlag
