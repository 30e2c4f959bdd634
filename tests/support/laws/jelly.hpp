// SPDX-License-Identifier: MIT
#pragma once
// A body of springs, tetrahedra and angles, for tests of all methods.

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "problems/problem.hpp"
#include "support/laws/laws_of_many.hpp"
#include "support/random.hpp"

namespace jetlag::testing {

using problems::Problem;

/// A cube in six tetrahedra about a diagonal, all volumes kept by pressure, the edges springs, some angles stiff. It is
/// free, spins and swings by some tenths; kinetic and potential energies are near 1.
template <class Edge = Spring, class Cell = Tetrahedron, class Corner = AngleByHand>
Problem jelly() {
  const std::vector<std::array<int, 4>> cells{{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                              {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  Uniform random(3);
  std::vector<double> mass(8);
  for (double& m : mass) m = random(0.5, 2);
  Problem scene{System<double>(3, mass), {0.0, Coordinates<double>(8, 3), Coordinates<double>(8, 3)}};
  for (int i = 0; i < 8; ++i) {
    for (int c = 0; c < 3; ++c) {
      scene.start.position(i, c) = ((i >> c) & 1) + random(-0.05, 0.05);
      scene.start.velocity(i, c) = random(-0.2, 0.2);
    }
    scene.start.velocity(i, 0) -= 0.3 * scene.start.position(i, 1);
    scene.start.velocity(i, 1) += 0.3 * scene.start.position(i, 0);
  }
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j)
      if ((i & j) == j) {  // along the edges of the cells
        edges.push_back({i, j});
        springs.push_back({8.0, std::sqrt(static_cast<double>(std::popcount(static_cast<unsigned>(i ^ j))))});
      }
  scene.system.template add<Edge>(edges, springs);
  std::vector<std::array<double, 2>> volumes;
  for (const auto& cell : cells) {
    const auto edge = [&](int i) {
      return Eigen::Vector3d((cell[i] & 1) - (cell[3] & 1), ((cell[i] >> 1) & 1) - ((cell[3] >> 1) & 1),
                             (cell[i] >> 2) - (cell[3] >> 2));
    };
    volumes.push_back({300.0, edge(0).dot(edge(1).cross(edge(2))) / 6});
  }
  scene.system.template add<Cell>(cells, volumes);
  scene.system.template add<Corner>({{1, 2, 0}, {5, 3, 7}, {2, 4, 6}}, {{2.0, 0.1}});
  return scene;
}

}  // namespace jetlag::testing
