// SPDX-License-Identifier: MIT
#pragma once
// Whether a step of Taylor's method agrees with the forces at its end. The next step begins with these, so that they are computed
// once; what it costs to compare them: BM_Check in bench/checks.cpp.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "jetlag/model/system.hpp"
#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// What is compared after a step of length h. All are largest components over all particles, in metres.
struct StepDefect {
  double time = 0, step = 0;  // of its beginning, h [s]
  double proposed = 0;        // the step that was tried first [s]
  double force = 0;     // d = h^2 |a - x''|: accelerations at the end, and those to which the series leads
  double position = 0;  // |x| at both ends
  double begun = 0;     // max(h |v|, h^2 |a|) at the beginning
  double ended = 0;     // the same at the end
};

/// Whether the defect d of a step is no larger than
///
///     2^16 eps max(|x| (h / h_0)^2, h |v|, h^2 |a|)            forces at rounded positions; |.|: at both ends
///   + 16 N e^(-2(N-1)) max(h |v|, h^2 |a|)                     what the step of Jorba and Zou leaves out; N: the largest degree;
///                                                              not where the step is given
///
/// and no more than a sixteenth of max(h |v|, h^2 |a|, 6 |x_3| h^3) at the beginning, or 4 times that where the step is given and
/// the degree random, of
///
///     N (N+1) tolerance (h / h_0)^2                            of a control with a tolerance of positions, in place of the second
///                                                              line: a series whose terms N, N+1 are as large
///   + 16 sum_{n>m} n (n-1) max(1, w_n) |x_n| h^n               what a law that stops at random after degree m adds and
///                                                              leaves out; for a fixed degree m the first term left out
///   + 8 eps |t/h| sum_{n>2} n (n-1) (n-2) |x_n| h^n            what the rounding of a late time makes of forces
///
/// over the terms that are known. Of a step that is chosen for a random degree the sum over n > m has no such limit: what is
/// rejected for a draw would bias the series. h_0: the step that was tried first, so that a jump of the force does not become
/// allowed by halving the step.
/// size(n) = |x_n| h^n [m], n <= order; weight(n) = max(1, w_n).
template <class Weight, class Size>
bool is_allowed(const StepDefect& defect, const TruncationLaw& law, double tolerance, bool is_given,
                const Weight& weight, int order, const Size& size);

/// What steps of a given length, which nothing may shorten, make of their defects. One that is not allowed moves the velocity
/// by d / h and the position by d; one that the terms explain by what the degree leaves out of each. Both go on as a free
/// motion:
///
///     g_x += e_x + h g_v,   g_v += e_v,
///
/// of what is beyond 64 roundings of the positions. Forces that hold a motion together may keep it nearer than g_x, or make it
/// chaotic.
class DefectLedger {
 public:
  /// Before the first step, from these positions.
  void begin(const Coordinates<double>& position) {
    if (steps_ == 0) take_extent(position);
  }
  /// What a step adds: e_x [m], e_v [m/s], and the positions at its end; who(): the particle concerned, asked when it is wanted.
  template <class Who>
  void add(const StepDefect& defect, double e_x, double e_v, const Coordinates<double>& position,
           const Who& who) {
    if (steps_ < 64 || steps_ % 64 == 0) take_extent(position);
    ++steps_;
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * defect.position;
    position_ += std::max(0.0, e_x - rounding) + defect.step * velocity_;
    velocity_ += std::max(0.0, e_v - rounding / defect.step);
    if (!(e_v * defect.step > 2 * largest_)) return;
    largest_ = e_v * defect.step;
    time_ = defect.time + defect.step;
    particle_ = who();
  }

  /// Where g_x is more than a thousandth of the extent of the positions so far: which steps, and where it was largest. Empty
  /// otherwise.
  std::string warning() const;

 private:
  void take_extent(const Coordinates<double>& position);

  std::uint64_t steps_ = 0;
  double velocity_ = 0, position_ = 0, largest_ = 0, time_ = 0;
  int particle_ = -1;
  Eigen::RowVectorXd low_, high_;  // of the positions
};

// ---- definitions -----------------------------------------------------------------------------------------

template <class Weight, class Size>
bool is_allowed(const StepDefect& defect, const TruncationLaw& law, double tolerance, bool is_given,
                const Weight& weight, int order, const Size& size) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  if (!std::isfinite(defect.force)) return false;
  const int degree = law.max_degree();
  const double part = defect.step / defect.proposed, motion = std::max(defect.begun, defect.ended);
  const double rounding = 0x1p16 * eps * std::max(part * part * defect.position, motion);
  if (defect.force <= rounding) return true;
  const double of_degree =
      tolerance > 0 || is_given ? 0.0 : 16 * degree * std::exp(-2.0 * (degree - 1)) * motion;
  if (defect.force <= rounding + of_degree) return true;
  const bool is_limited = law.is_fixed() || is_given;
  const double begun = std::max(defect.begun, order < 3 ? 0.0 : 6 * size(3));
  const double most = begun * (law.is_fixed() ? 1.0 / 16 : 4.0);
  double limited = part * part * (degree * (degree + 1)) * tolerance, random = 0;
  const auto fits = [&] { return defect.force <= rounding + of_degree + random + std::min(limited, most); };
  // The terms are looked at as far as it takes.
  for (int n = std::max(2, law.min_degree() + 1); n <= order && !fits(); ++n)
    (is_limited ? limited : random) += 16 * weight(n) * (n * (n - 1)) * size(n);
  const double time = 8 * eps * std::abs(defect.time / defect.step);
  for (int n = 3; n <= order && !fits(); ++n) limited += time * (n * (n - 1) * (n - 2)) * size(n);
  return fits();
}

}  // namespace jetlag
