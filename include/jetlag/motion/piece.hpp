// SPDX-License-Identifier: MIT
#pragma once
// A piece: polynomials of the motion, and the interval on which they hold.

#include <vector>

#include "jetlag/model/system.hpp"
#include "jetlag/motion/coefficients.hpp"
#include "jetlag/series/calculus/polynomial.hpp"

namespace jetlag {

/// Positions and velocities of all particles on [begin, end], as polynomials in (t - begin) / unit.
/// Weights of a random truncation are part of the coefficients.
struct Piece {
  double begin = 0, end = 0;  // [s]
  Coefficients position{};    // coefficient k: shape (particles, dimension)
  Coefficients velocity{};
  double unit = 1;  // [s], other than 1 only where coefficients in seconds would over- or underflow

  bool holds(double t) const { return begin <= t && t <= end; }

  /// The state at a time of the interval, by Horner's rule.
  State<double> at(double t) const;
  /// The same into a state whose storage is kept where it fits.
  void at(double t, State<double>& into) const;

  /// The same motion with its polynomials about a new origin t; it holds on [t, end].
  Piece about(double t) const;
};

/// The position polynomials of one particle in (t - begin) / unit, component by component: shape
/// (dimension)(degree + 1).
std::vector<std::vector<double>> polynomials(const Piece& piece, int particle);

}  // namespace jetlag
