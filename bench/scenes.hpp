// SPDX-License-Identifier: MIT
#pragma once
// The scenes on which the benchmarks run.

#include <cstddef>
#include <string>

#include "jetlag/model/system.hpp"

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

/// A light body on a planar orbit of eccentricity 1/2 about a heavy one, G = 1.
Scene planar_kepler();

/// The Sun with the inner planets, Jupiter, Saturn, Uranus, Neptune and Pluto; astronomical units and days.
/// Source: [HLW06] I.2.4, heliocentric positions and velocities of September 5, 1994.
Scene solar();

/// A pendulum in its angle: x'' = -sin x, at rest at 1.3.
Scene pendulum();

/// A scene with a stiff part, the longest stable step of its soft part and a step that is exact for its stiff one.
struct Uneven {
  System<double> system;
  State<double> state;
  double until, max_step, exact_step;
};

/// F = k (1 + |d|^2) d.
struct CubicSpring {
  static constexpr const char* name = "cubic spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(stiffness * (1.0 + d.squaredNorm())) * d;
  }
};

/// 128 masses between walls; four of 129 springs are 1e4 times stiffer.
Uneven chain();

/// By name: cloth<side>, kepler, planar_kepler, solar, pendulum.   Throws std::invalid_argument.
Scene scene(const std::string& name);

}  // namespace jetlag::bench
