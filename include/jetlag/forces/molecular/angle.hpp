// SPDX-License-Identifier: MIT
#pragma once
// The angle between two bonds.

#include <array>

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// E = k/2 (cos phi - c)^2,   cos phi = a . b / (|a| |b|),   a = x_0 - x_1,   b = x_2 - x_1.
/// Participants along the bonds: the angle is at the second. stiffness k [J], cosine c [1], in [-1, 1], that at rest. The
/// forces follow from the energy.
/// Source: W. van Gunsteren, H. Berendsen, Groningen Molecular Simulation (GROMOS) library manual, 1987: for its cosine the
/// law has no singularity where the bonds are in line.
/// Range: bonds of some length.   Conserves: momentum, angular momentum, energy.
struct Angle {
  static constexpr const char* name = "angle";
  static constexpr int participants = 3;
  static constexpr std::array dimensions{2, 3};
  static constexpr std::array parameters{"stiffness", "cosine"};

  template <class T, int D>
  static T energy(const Participants<T, D, 3>& p, const T& stiffness, const T& cosine) {
    const Vector<T, D> a = p.position[0] - p.position[1], b = p.position[2] - p.position[1];
    const T off = T(a.dot(b)) / (a.norm() * b.norm()) - cosine;
    return T(0.5) * stiffness * off * off;
  }
};

extern template RecordedLaw record_law<Angle>(int);  // recorded in src/forces

}  // namespace jetlag
