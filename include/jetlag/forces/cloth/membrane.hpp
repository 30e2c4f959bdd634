// SPDX-License-Identifier: MIT
#pragma once
// Sheets of triangles in space: what resists stretching and shearing, and its viscosity. Bending is a law of its own.

#include "jetlag/forces/solids/kelvin_voigt.hpp"
#include "jetlag/forces/solids/stvk.hpp"

namespace jetlag {

/// The law of Stvk of a triangle in space, whose strain is that in its plane: G is the Gram matrix of two edges, V the area
/// times the thickness t. In terms of forces a length: lambda t, mu t [N/m].
/// Participants in any order. lambda, mu: Lame's constants [Pa], mu > 0, lambda + mu > 0; thickness [m], > 0. A thin sheet is
/// free of stress across it: take `plane_stress` of the constants of its material (forces/solids/lame.hpp).
/// Source: as of Stvk.
/// Range: everywhere, without kinks. Under compression sheets buckle and wrinkle, and below a stretch of 1/sqrt 3 a triangle
/// gives way.   Conserves: momentum, angular momentum, energy.
struct Membrane : detail::StvkSimplex<2, 3> {
  static constexpr const char* name = "membrane";
};

/// The viscosity of KelvinVoigt of the same triangle. viscosities [Pa s]: mu >= 0, lambda + mu >= 0; those of plane stress
/// where its elasticity is.   Conserves: momentum, angular momentum.
struct MembraneKelvinVoigt : detail::KelvinVoigtSimplex<2, 3> {
  static constexpr const char* name = "membrane_kelvin_voigt";
};

extern template RecordedLaw record_law<Membrane>(int);  // recorded in src/forces
extern template RecordedLaw record_law<MembraneKelvinVoigt>(int);

}  // namespace jetlag
