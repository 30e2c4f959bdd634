// SPDX-License-Identifier: MIT
#pragma once
// Nets of springs.

#include <cstdint>

#include "problems/problem.hpp"

namespace jetlag::problems {

/// Eight particles near the corners of a cube, all pairs at rest length, moving slowly; masses, stiffnesses
/// (1 .. 3) and velocities from the seed. Nothing acts from outside. Its frequencies are below 7.
Problem spring_cube(std::uint64_t seed);

/// side x side particles of 1 kg, 0.1 m apart, slightly disturbed; springs of 5 kN/m to the neighbours along
/// the grid (structural), across its meshes (shear) and to the next but one (bend).
Problem cloth(int side);

/// 50 x 50 particles of 1 kg, 0.1 m apart, springs as in `cloth` of 5 N/m; those within a square of 5 % are 1e3 times
/// stiffer. It begins flat, with a smooth velocity, until 4.
Problem cloth_with_a_stiff_patch();

}  // namespace jetlag::problems
