// SPDX-License-Identifier: MIT
#pragma once
// Hermite's method of order 4: accelerations and their derivatives, the jerk, from the tape.

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "jetlag/integrators/force_rounding.hpp"
#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

/// Predictor:  x_p = x_0 + h v_0 + h^2/2 a_0 + h^3/6 j_0,   v_p = v_0 + h a_0 + h^2/2 j_0.
/// Corrector, `iterations` times, a_1 and j_1 evaluated at what is known of the end:
///     v_1 = v_0 + h/2 (a_0 + a_1) + h^2/12 (j_0 - j_1),   x_1 = x_0 + h/2 (v_0 + v_1) + h^2/12 (a_0 - a_1).
/// The next step evaluates a_0 and j_0 at the corrected end, so that a step depends on its state alone: iterations + 1
/// evaluations of two orders a step (P(EC)^n E). Order 4; with iterations until nothing changes (some 5) and fixed steps
/// symmetric in time. The jerk is three times coefficient 3 of the motion, times 2: it is right for drag too.
/// Source: Makino, Aarseth, PASJ 44 (1992) 141; Hut, Makino, McMillan, ApJ 443 (1995) L93 (iterations).
class Hermite final : public OneStep {
 public:
  struct Options {
    int iterations =
        1;  // >= 1; two at least where forces depend on velocities, whose prediction is of lower order
    /// Aarseth's step, h^2 = accuracy (|a| |s| + |j|^2) / (|j| |c| + |s|^2), the least over the moving particles, at
    /// most twice the last one: s = x'''' and c = x''''' at the end of the last step, from the interpolation, for the
    /// first step from the series.  Source: Aarseth 1985.
    /// Where |s| and |c| may be rounding of the accelerations that they are differences of (force_rounding.hpp), they
    /// count as what they are more than that: a particle at rest bounds no step.
    double accuracy = 0.01;                                     // eta > 0
    double max_step = std::numeric_limits<double>::infinity();  // [s], > 0
    std::optional<double> step{};  // [s], > 0: steps of this length in place of those
  };
  /// Throws std::invalid_argument.
  Hermite(const System<double>& system, const Options& options);

  /// Hermite's interpolation of x, v and a at both ends: errors of O(h^6) in x and O(h^5) in v within a step.
  Piece piece() const override;

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
  double aarseth_length(const State<double>& from, Report& report);
  bool may_be_rounding(int particle) const;
  std::pair<double, double> rounding(int particle);

  static constexpr double roundings = 2;  // of a position in a step

  Options options_;
  std::vector<bool> fixed_;
  std::vector<Coordinates<double>> d0_, d1_;  // a and j at both ends of the last step
  State<double> end_;                         // of the last step; empty before the first
  ForceRounding rounding_;
  std::vector<Coordinates<double>> noise_;  // of a and j over the last step; empty: not measured
};

}  // namespace jetlag
