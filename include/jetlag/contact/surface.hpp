// SPDX-License-Identifier: MIT
#pragma once
// What may touch: vertices, edges and faces of particles.

#include <array>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// Vertices are particles. Faces bring their edges and vertices with them, edges their vertices: each is there once.
class Surface {
 public:
  Surface() = default;

  /// Lists of particles: triangles in space, edges, single points. Throws std::invalid_argument for one in which a particle is
  /// named twice, and for one that is listed twice.
  Surface(const std::vector<std::array<int, 3>>& triangles, const std::vector<std::array<int, 2>>& edges,
          const std::vector<int>& points);

  /// Both.
  Surface& operator+=(const Surface& other);

  const std::vector<int>& vertices() const { return vertices_; }           // ascending
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }  // ascending, each from low to high
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }  // ascending, each too
  /// Vertices of no edge, edges of no triangle; ascending.
  const std::vector<int>& loose_vertices() const { return loose_vertices_; }
  const std::vector<std::array<int, 2>>& loose_edges() const { return loose_edges_; }

 private:
  void complete();

  std::vector<int> vertices_, loose_vertices_;
  std::vector<std::array<int, 2>> edges_, loose_edges_;
  std::vector<std::array<int, 3>> triangles_;
};

/// For each particle the least of those that edges join it to, step by step: the same for all of one body.
std::vector<int> bodies_of(const Surface& surface, int particles);

}  // namespace jetlag
