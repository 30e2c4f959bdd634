// SPDX-License-Identifier: MIT
#pragma once
// How much of the accelerations is rounding: what a control of the step must not take for the motion.

#include <cstdint>
#include <span>
#include <vector>

#include "jetlag/integrators/accelerations.hpp"

namespace jetlag {

/// A force is evaluated at positions that are rounded: its value is uncertain by |da/dx| eps |x|, whatever its size.
/// Where forces cancel (rest, a small motion far from the origin) that is more than differences of accelerations are
/// made of, and these no longer fall with the step. How much it is, is measured: the accelerations at a state whose
/// positions, velocities and time are moved by some roundings,
///     x -> x + n eps (|x| + h |v|) u,   v -> v + n eps (|v| + h |a|) u,   t -> t + n eps (|t| + h) u,
/// 1/2 <= |u| < 1, different from one number to the next (by Weyl's sequence of the golden section), minus those at the
/// state itself. One evaluation; all of it scales with the units of the scene. Below 1e-292, where doubles are equally
/// far apart, a rounding is the least double.
class ForceRounding {
 public:
  explicit ForceRounding(const System<double>& system);

  /// How far n roundings move the derivatives of the motion in a step of length h [s] from the state: `known` are its
  /// a, j, .. there, entry k of the result has the unit m/s^(k+2). Shape (particles, dimension), >= 0; zero where the
  /// moved state has no finite forces.
  std::vector<Coordinates<double>> operator()(const State<double>& state, double h, double n,
                                              std::span<const Coordinates<double>> known);

  /// (element, order) pairs computed.
  std::uint64_t element_coefficients() const { return accelerations_.element_coefficients(); }

 private:
  std::vector<bool> fixed_;
  Accelerations accelerations_;
};

}  // namespace jetlag
