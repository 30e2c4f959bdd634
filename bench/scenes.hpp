// SPDX-License-Identifier: MIT
#pragma once
// The scenes on which the benchmarks run.

#include <cstddef>
#include <string>

#include "jetlag/motion/system.hpp"

namespace jetlag::bench {

struct Scene {
  std::string name;
  System<double> system;
  State<double> state;

  std::size_t elements() const;  // springs or pairs
};

/// side x side particles of 1 kg, 0.1 m apart, slightly disturbed; springs of 5 kN/m to the neighbours along
/// the grid (structural), across its meshes (shear) and to the next but one (bend).
Scene cloth(int side);

/// Two bodies that attract each other, masses 3 and 1, G = 1, on an ellipse inclined to all axes.
Scene kepler();

/// By name: cloth10, cloth50, kepler.   Throws std::invalid_argument.
Scene scene(const std::string& name);

}  // namespace jetlag::bench
