// SPDX-License-Identifier: MIT
#pragma once
// Spring of rest length 0 between two particles.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F_0 = k d,   d = x_1 - x_0;   E = k/2 |d|^2.         Source: Hooke; LaCoste (1934), who built them for seismographs.
/// stiffness k [N/m].   Range: all d; the ends may coincide and pass through each other, for the force is linear: no
/// direction of d is asked for, and there is no kink where it vanishes, as there is for a Spring of any length.
/// Conserves: momentum, angular momentum, energy.   Cost: a product for each component.
struct ZeroLengthSpring {
  static constexpr const char* name = "zero_length_spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return stiffness * d;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(0.5) * stiffness * T(d.squaredNorm());
  }

  static double stiffness(double k) { return k; }
};

extern template RecordedLaw record_law<ZeroLengthSpring>(int);  // recorded in src/forces

}  // namespace jetlag
