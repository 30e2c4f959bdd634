// SPDX-License-Identifier: MIT
#include "jetlag/scenes/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace jetlag {

double six_volumes(const Coordinates<double>& position, const std::array<int, 4>& t) {
  const auto side = [&](int corner) { return Eigen::Vector3d(position.row(t[corner]) - position.row(t[0])); };
  return side(1).cross(side(2)).dot(side(3));
}

std::vector<std::array<int, 2>> edges_of(const std::vector<std::array<int, 4>>& tetrahedra,
                                         const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::array<int, 2>> edges;
  const auto add = [&](const auto& cell) {
    for (std::size_t a = 0; a < cell.size(); ++a)
      for (std::size_t b = a + 1; b < cell.size(); ++b)
        edges.push_back({std::min(cell[a], cell[b]), std::max(cell[a], cell[b])});
  };
  for (const auto& t : tetrahedra) add(t);
  for (const auto& t : triangles) add(t);
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace jetlag
