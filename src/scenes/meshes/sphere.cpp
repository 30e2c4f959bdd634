// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "jetlag/scenes/mesh.hpp"

namespace jetlag {

namespace {

/// Twelve vertices, at (0, +-1, +-g) and what comes of them when the axes change places in a circle; g = (1 + sqrt 5) / 2.
std::vector<Eigen::Vector3d> icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> vertices;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {-1.0, 1.0})
      for (const double other : {-g, g}) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        x[(axis + 1) % 3] = one;
        x[(axis + 2) % 3] = other;
        vertices.push_back(x);
      }
  return vertices;
}

/// Its faces: the threes of vertices that are 2 from each other, turning left when seen from outside.
std::vector<std::array<int, 3>> faces_of(const std::vector<Eigen::Vector3d>& x) {
  std::vector<std::array<int, 3>> faces;
  const auto n = static_cast<int>(x.size());
  const auto are_near = [&](int a, int b) { return (x[a] - x[b]).squaredNorm() < 5; };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = b + 1; c < n; ++c) {
        if (!are_near(a, b) || !are_near(b, c) || !are_near(a, c)) continue;
        const bool turns_left = x[a].dot(x[b].cross(x[c])) > 0;
        faces.push_back(turns_left ? std::array{a, b, c} : std::array{a, c, b});
      }
  return faces;
}

}  // namespace

Mesh geodesic_sphere(double radius, int cells) {
  if (!(radius > 0) || !std::isfinite(radius)) throw std::invalid_argument("radius: must be > 0");
  if (cells < 1) throw std::invalid_argument("cells: must be >= 1");
  const std::vector<Eigen::Vector3d> corners = icosahedron();
  // A vertex is an average of corners in parts of 1 / cells: faces that share an edge have the same ones there.
  using Parts = std::array<int, 12>;
  std::map<Parts, int> numbers;
  std::vector<Eigen::Vector3d> places;
  Mesh mesh;
  for (const auto& face : faces_of(corners)) {
    const auto vertex = [&](int i, int j) {  // i steps from the first corner to the second, j to the third
      Parts parts{};
      parts[face[0]] += cells - i - j;
      parts[face[1]] += i;
      parts[face[2]] += j;
      const auto [known, is_new] = numbers.emplace(parts, static_cast<int>(places.size()));
      if (is_new) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (std::size_t c = 0; c < corners.size(); ++c) x += parts[c] * corners[c];
        places.push_back(radius * x.normalized());
      }
      return known->second;
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < cells)
          mesh.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  mesh.position.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) mesh.position.row(static_cast<Eigen::Index>(i)) = places[i];
  mesh.edges = edges_of({}, mesh.triangles);
  return mesh;
}

}  // namespace jetlag
