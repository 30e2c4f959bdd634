// SPDX-License-Identifier: MIT
#pragma once
// Two masses in a row, one a million times the other, or one of two springs.

#include <array>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// F = -k d on a pair, of no rest length.
struct Bond {
  static constexpr const char* name = "bond";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& k) {
    return T(k) * Vector<T, D>(p.position[1] - p.position[0]);
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& k) {
    return T(0.5) * k * T((p.position[1] - p.position[0]).squaredNorm());
  }
};

/// wall - spring of 1 N/m - 1 kg - spring of k - mass m. Particle 0 is the wall; x are displacements.
struct HeavyAndLight {
  System<double> system;
  State<double> start{0.0, Coordinates<double>::Zero(3, 1), Coordinates<double>::Zero(3, 1)};

  HeavyAndLight(double k, double m) : system(1, {1.0, 1.0, m}) {
    system.fix(0);
    system.add<Bond>({{0, 1}, {1, 2}}, {{1.0}, {k}});
    start.velocity(1, 0) = 1;
  }
};

/// The light mass runs a thousand times as fast as the heavy one, and shakes it by a millionth of its own amplitude: by
/// 1e-9 m at 1000 a second.
inline HeavyAndLight light_mass() { return {1.0, 1e-6}; }

/// Both masses are equally fast and equally far out: there is nothing to be saved.
inline HeavyAndLight stiff_spring() {
  HeavyAndLight scene(1e6, 1.0);
  scene.start.position(2, 0) = 1e-3;
  return scene;
}

constexpr double fast_frequency = 1000.0005000003749998125;  // of light_mass [1/s]

}  // namespace jetlag
