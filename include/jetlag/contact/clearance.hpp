// SPDX-License-Identifier: MIT
#pragma once
// Whether a surface is such that its contacts can begin.

#include <optional>

#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/contact/stencil.hpp"

namespace jetlag {

/// Throws std::invalid_argument, naming the features, where two of them that may touch are no more than the gap apart at a
/// position, and where an edge passes through a triangle or, in the plane, through another edge. Signs of volumes are those of
/// sums in long double, of differences that are rounded once.
/// A surface that lies inside another one passes through nothing.
void require_apart(const System<double>& system, const ContactBarrier& contact,
                   const Coordinates<double>& position);

/// Two features, and how far they are apart [m].
struct Clearance {
  Stencil stencil;
  double distance;
};

/// Of a surface that touches itself, the features of one body without a common vertex that are nearest to each other at rest;
/// nothing if all are farther apart than gap and thickness together. Nearer ones push each other apart all the time.
std::optional<Clearance> nearest_of_one_body(const System<double>& system, const ContactBarrier& contact);

}  // namespace jetlag
