// SPDX-License-Identifier: MIT
#pragma once
// Boxes of tetrahedra.

#include <array>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag::problems {

struct TetrahedralMesh {
  Coordinates<double> position;                // [m], shape (vertices, 3)
  std::vector<std::array<int, 4>> tetrahedra;  // of positive volume, in the usual order
};

/// Kuhn mesh nx x ny x nz: the box [0, lengths] in cubes, each cut in 6 along (1, 1, 1).
/// Vertex (i (ny + 1) + j)(nz + 1) + k stands at (i, j, k) cells. The tetrahedra of a cube are next to each other; refined
/// to half the cells the mesh is cut along its own faces.
TetrahedralMesh kuhn_mesh(const std::array<int, 3>& cells, const std::array<double, 3>& lengths);

/// The faces that belong to one tetrahedron, counterclockwise as seen from outside.
std::vector<std::array<int, 3>> boundary_faces(const std::vector<std::array<int, 4>>& tetrahedra);

}  // namespace jetlag::problems
