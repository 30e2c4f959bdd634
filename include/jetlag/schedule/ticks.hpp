// SPDX-License-Identifier: MIT
#pragma once
// Ticks: times as whole numbers of a unit, so that clocks meet exactly and nothing drifts.
//
//     t = origin + n unit,   unit = base / 2^52
//
// A step of level l is base / 2^l: a whole number of ticks. A difference of two times within one base step is exact.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace jetlag {

class Ticks {
 public:
  using Count = std::int64_t;
  static constexpr int finest = 52;  // level of a step of one tick

  Ticks() = default;
  /// origin, base [s]; base > 0 and finite.
  Ticks(double origin, double base) : origin_(origin), unit_(std::ldexp(base, -finest)) {}

  double seconds(Count n) const { return static_cast<double>(n) * unit_; }
  double time(Count n) const { return origin_ + seconds(n); }

  /// t - time(n), with no more rounding than t - origin has.
  double since(Count n, double t) const { return std::fma(-static_cast<double>(n), unit_, t - origin_); }

  /// The ticks in a step of a level, 0 .. finest.
  static constexpr Count step(int level) { return Count{1} << (finest - level); }

  /// The coarsest level of which n is a whole number of steps.
  static int coarsest(Count n) {
    return n == 0 ? 0 : std::max(0, finest - std::countr_zero(static_cast<std::uint64_t>(n)));
  }

  /// The coarsest level whose step is at most h; beyond `finest` where there is none.
  int level(double h) const {
    if (!(h > 0)) return finest + 1;
    int e;
    const double f = std::frexp(std::ldexp(unit_, finest) / h, &e);  // 2^(e-1) <= base/h < 2^e
    return std::clamp(f == 0.5 ? e - 1 : e, 0, finest + 1);
  }

  /// The ticks in h, rounded down; at most those of a base step.
  Count in(double h) const {
    return h >= std::ldexp(unit_, finest) ? step(0) : static_cast<Count>(h / unit_);
  }

 private:
  double origin_ = 0, unit_ = 1;
};

}  // namespace jetlag
