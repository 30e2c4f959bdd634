// SPDX-License-Identifier: MIT
#pragma once
// When a stencil whose vertices move on polynomials comes nearer than a distance eta, for the first time, whatever the regions
// that its closest points pass through.
//
// A direction v separates the sides while  v.x_i - v.x_j > eta |v|  for all i of side A and j of side B. In the Bernstein
// basis of the interval both are averages of control points with the same weights, so that it is enough to compare them
// one by one: sides that move together stay apart however far they go. The ways between the closest points at both ends of
// the interval are tried as v, and the direction that turns from the one to the other. Where none will do, the interval is
// halved, and its first half is looked at first. A piece of 2^-30 of the step that cannot be proved separate counts as
// contact: a hit may be false by what the motion does in that time, or where d (d - eta) is below eps S^2, as rounding turns
// directions by eps S / d; but none is missed. Against rounding, which may hide contact, eta is widened:
//     by 64 eps |x|, what positions at |x| may be off when they come here, and by 32 (N+2) eps S, S the size of the stencil
//     and its motion, what rounding may make of them here: below 2^-30, thirty splits of N eps/2 each, on both sides.
//
//   Approach approach;
//   const PathView paths[] = {{p, 4, 12}, {a, 4, 12}, {b, 4, 12}, {c, 4, 0}};      c is at rest
//   approach.first(StencilKind::vertex_face, paths, h, eta)                        std::nullopt, or a time in [0, h]
//
// Cost: mostly one or two directions of (N+1)^2 sums each; a split takes 6 (N+1)^2. On a step through which sides turn against
// each other at a distance d just above eta, some 1 / sqrt(1 - eta/d) pieces are looked at; at a touch some hundred.

#include <optional>
#include <span>
#include <vector>

#include "jetlag/contact/closest.hpp"
#include "jetlag/model/path_view.hpp"

namespace jetlag {

/// Memory for the search: one for each thread, reused from stencil to stencil, so that nothing is allocated but where the
/// degree grows.
class Approach {
 public:
  /// The first time [s] at which the stencil is at most eta [m] >= 0 apart, in the step from 0 to h [s] > 0: 0 if it begins
  /// so, else in (0, h], by less than 1e-9 h before the time at which d comes down to the widened eta (behind it only if that
  /// itself is below 1e-9 h). Nothing if it stays apart for all of the step: that is certain.
  /// vertices: in the order of the kind, of any degrees.
  /// Throws std::invalid_argument for coefficients that are not finite, for polynomials that overflow in the step, unless
  /// eta >= 0, h > 0 and both are finite.
  std::optional<double> first(StencilKind kind, std::span<const PathView> vertices, double h, double eta);

  /// Whether it is at most eta apart anywhere in the step.
  bool comes_within(StencilKind kind, std::span<const PathView> vertices, double h, double eta) {
    return first(kind, vertices, h, eta).has_value();
  }

  /// How many pieces of the step the last search has looked at: 1 where the step as a whole was enough.
  int pieces() const { return pieces_; }

 private:
  struct Search;

  int pieces_ = 0;
  std::vector<double> rows_;  // control points of the pieces on the way down
};

}  // namespace jetlag
