// SPDX-License-Identifier: MIT
#pragma once
// Cells of a plane grid, each cut into two triangles.

#include "jetlag/scenes/mesh.hpp"

namespace jetlag {

/// Adds the triangles of across x along cells, counterclockwise. vertex(i, j): its number; is_cut_upwards(i, j): whether the
/// diagonal of cell (i, j) runs from that vertex to (i + 1, j + 1), or else from (i + 1, j) to (i, j + 1).
template <class Vertex, class Cut>
void add_triangles(int across, int along, Vertex vertex, Cut is_cut_upwards, Mesh& mesh) {
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if (is_cut_upwards(i, j)) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
}

}  // namespace jetlag
