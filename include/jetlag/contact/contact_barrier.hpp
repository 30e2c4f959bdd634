// SPDX-License-Identifier: MIT
#pragma once
// Contact by a barrier: features of a surface that come near each other are pushed apart by a force that grows without bound
// as the gap closes (forces/contact/barrier.hpp).
//
//   System<> system(3, mass);
//   add(system, ContactBarrier{.surface = Surface(triangles, {}, {}), .rest = x, .thickness = 0.01, .stiffness = 1e3});
//   taylor(system, 20, std::make_unique<JorbaZou>()) ...
//
// Elements come and go (model/changing_elements.hpp): one for each pair of features whose gap is below the thickness, of the
// region that carries their distance. While it is there its force is analytic; steps that are chosen end where
//   - a gap falls below the thickness, less a part of 1e-6 of it, or exceeds it by as much: a switch with hysteresis, so that
//     a contact without relative velocity does not stop the motion. The energy it misses is 1e-18 of what a full contact holds;
//   - another region becomes the nearest: across such a switch the second derivative of the distance jumps;
//   - a gap falls to half of what it was at the beginning of the step. No step is so long that it passes a barrier, however
//     loose the tolerance.
// With a clock for each particle, the particles of a pair are due together where it changes.
// Steps that are given do not end there: elements are those at the beginning of a step, and a step in which a gap changes by more
// than half fails as `contradicted`. That nothing is passed does not make them accurate: they are to be short against a contact.
//
// Conserves energy, momentum, angular momentum.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "jetlag/contact/contact_record.hpp"
#include "jetlag/contact/surface.hpp"
#include "jetlag/model/changing_elements.hpp"
#include "jetlag/model/system.hpp"

namespace jetlag {

struct ContactBarrier {
  Surface surface;
  Coordinates<double> rest;  // where the surface is at rest [m], shape (particles, dimension)
  double thickness = 0;      // dh > 0: of the layer in which the barrier acts [m]
  double stiffness = 0;      // kappa > 0 [N/m]
  double gap = 0;            // xi >= 0: what is always kept [m]
  double power = 7;          // q, 1 to 7: how fast the barrier grows
  bool with_itself = true;   // whether one body, held together by its edges and triangles, touches itself
  std::shared_ptr<ContactRecord>
      record{};  // where what it has done is counted; not by several runs at once. null: nowhere
};

/// Throws std::invalid_argument for numbers out of range, particles that do not exist, triangles in the plane, edges and triangles
/// without extent at rest, and a rest of another shape.
void add(System<double>& system, const ContactBarrier& contact);

}  // namespace jetlag
