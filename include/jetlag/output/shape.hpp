// SPDX-License-Identifier: MIT
#pragma once
// What a scene looks like: the parts a picture or a file draws, and where they are at one time.

#include <array>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// The parts that stay the same during the motion; all numbers are particles, counted from 0.
struct Shape {
  int dimension = 0;  // 1, 2 or 3
  int particles = 0;
  std::vector<std::array<int, 2>> lines;       // springs
  std::vector<std::array<int, 3>> surface;     // triangles; seen from outside they turn left
  std::vector<std::array<int, 4>> tetrahedra;  // the inside
  std::vector<int> fixed;                      // without the vertices of obstacles
  int obstacles = 0;                           // so many particles, the last ones, are vertices of obstacles
  std::vector<std::array<int, 2>> walls{};     // edges of obstacles that are of no triangle
  std::array<int, 3> up{0, 1, 0};  // in space, the way up of a picture: one of the axes or its opposite
};

/// Where everything is at one time.
struct Frame {
  double time = 0;                         // [s]
  Coordinates<double> position, velocity;  // [m], [m/s]: shape (particles, dimension)

  /// Of each particle, where the clocks of a run are recorded: the step of its last update, and the degree; else empty.
  std::vector<double> step{};  // [s]
  std::vector<int> degree{};

  /// Of each particle, where there are contacts: its smallest gap, infinite where nothing is within the thickness, and the force
  /// of its contacts; else empty.
  std::vector<double> gap{};            // [m]
  Coordinates<double> contact_force{};  // [N]
};

/// The triangles that belong to one tetrahedron only, turning left when seen from outside, in the order in
/// which the tetrahedra name them. position [m] tells outside from inside; the tetrahedra may be wound either
/// way.
/// Throws std::invalid_argument for a particle that does not exist and for a position that is not in space.
std::vector<std::array<int, 3>> boundary(const std::vector<std::array<int, 4>>& tetrahedra,
                                         const Coordinates<double>& position);

/// Throws std::invalid_argument, naming the particle, unless the frame fits the shape and all its numbers are
/// finite.
void check_frame(const Shape& shape, const Frame& frame);

}  // namespace jetlag
