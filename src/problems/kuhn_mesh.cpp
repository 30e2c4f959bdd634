// SPDX-License-Identifier: MIT
#include "problems/kuhn_mesh.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace jetlag::problems {

TetrahedralMesh kuhn_mesh(const std::array<int, 3>& cells, const std::array<double, 3>& lengths) {
  const auto vertex = [&](const std::array<int, 3>& at) {
    return (at[0] * (cells[1] + 1) + at[1]) * (cells[2] + 1) + at[2];
  };
  // From corner (0, 0, 0) of a cube to (1, 1, 1) along the axes in every order: an odd one needs two vertices exchanged.
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  TetrahedralMesh mesh;
  mesh.position.resize((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), 3);
  for (int i = 0; i <= cells[0]; ++i)
    for (int j = 0; j <= cells[1]; ++j)
      for (int k = 0; k <= cells[2]; ++k) {
        const std::array<int, 3> corner{i, j, k};
        for (int axis = 0; axis < 3; ++axis)
          mesh.position(vertex(corner), axis) = lengths[axis] * corner[axis] / cells[axis];
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        for (const auto& order : orders) {
          std::array<int, 3> at = corner;
          std::array<int, 4> tetrahedron{vertex(at)};
          for (int step = 0; step < 3; ++step) {
            ++at[order[step]];
            tetrahedron[step + 1] = vertex(at);
          }
          if ((order[0] + 1) % 3 != order[1]) std::swap(tetrahedron[2], tetrahedron[3]);
          mesh.tetrahedra.push_back(tetrahedron);
        }
      }
  return mesh;
}

std::vector<std::array<int, 3>> boundary_faces(const std::vector<std::array<int, 4>>& tetrahedra) {
  std::map<std::array<int, 3>, std::array<int, 3>> once;  // by sorted vertices
  for (const auto& [a, b, c, d] : tetrahedra)
    for (const std::array<int, 3>& face : {std::array{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) {
      std::array<int, 3> key = face;
      std::ranges::sort(key);
      if (!once.emplace(key, face).second) once.erase(key);
    }
  std::vector<std::array<int, 3>> faces;
  for (const auto& [key, face] : once) faces.push_back(face);
  return faces;
}

}  // namespace jetlag::problems
