// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/triangle_grid.hpp"

namespace jetlag {

namespace {

/// Whether a cell is cut from its lower left corner to the upper right one.
bool is_cut_upwards(SheetPattern pattern, int i, int j) {
  switch (pattern) {
    case SheetPattern::equilateral:
      return j % 2 == 1;  // the short diagonal, of a row whose upper side is shifted back
    case SheetPattern::crisscross: return (i + j) % 2 == 1;
    case SheetPattern::uniform: break;
  }
  return true;
}

}  // namespace

Mesh sheet(std::array<double, 2> lengths, std::array<int, 2> cells, SheetPattern pattern) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!(lengths[axis] > 0) || !std::isfinite(lengths[axis]))
      throw std::invalid_argument("lengths: two numbers > 0 are needed");
    if (cells[axis] < 1) throw std::invalid_argument("cells: two numbers >= 1 are needed");
  }
  const auto [across, along] = cells;
  const auto vertex = [&](int i, int j) { return i * (along + 1) + j; };
  Mesh mesh;
  mesh.position.resize((across + 1) * (along + 1), 3);
  for (int i = 0; i <= across; ++i)
    for (int j = 0; j <= along; ++j) {
      const double shift = pattern == SheetPattern::equilateral && j % 2 == 1 ? 0.5 : 0.0;
      mesh.position.row(vertex(i, j)) << lengths[0] * (i + shift) / across, lengths[1] * j / along, 0;
    }
  add_triangles(across, along, vertex, [&](int i, int j) { return is_cut_upwards(pattern, i, j); }, mesh);
  mesh.edges = edges_of({}, mesh.triangles);
  return mesh;
}

}  // namespace jetlag
