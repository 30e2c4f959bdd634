// SPDX-License-Identifier: MIT
#pragma once
// A piece: polynomials of the motion, and the interval on which they hold.

#include <span>
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

/// A piece whose coefficients stand where somebody else has them: it ends with those.
struct PieceView {
  double begin, end;  // [s]
  CoefficientsView position, velocity;
  double unit;  // [s]

  PieceView(double begin, double end, const CoefficientsView& position, const CoefficientsView& velocity,
            double unit)
      : begin(begin), end(end), position(position), velocity(velocity), unit(unit) {}
  PieceView(const Piece& piece)  // implicit: as a span of a vector
      : PieceView(piece.begin, piece.end, piece.position, piece.velocity, piece.unit) {}

  bool holds(double t) const { return begin <= t && t <= end; }
  State<double> at(double t) const;
  void at(double t, State<double>& into) const;
  /// At several times, with the same bits; of few particles in less time. into: one for each.
  void at(std::span<const double> times, std::span<State<double>> into) const;

  /// A copy with memory of its own.
  Piece copy() const { return {begin, end, Coefficients(position), Coefficients(velocity), unit}; }
};

/// The position polynomials of one particle in (t - begin) / unit, component by component: shape
/// (dimension)(degree + 1).
std::vector<std::vector<double>> polynomials(const PieceView& piece, int particle);

}  // namespace jetlag
