// SPDX-License-Identifier: MIT
#pragma once
// Linear spring between two particles.

#include <limits>

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F_0 = k (|d| - L) d / |d|,   d = x_1 - x_0;   E = k/2 (|d| - L)^2.         Source: Hooke.
/// stiffness k [N/m], rest_length L [m].   Range: d != 0. There the force is not finite from coefficient 1 on; of
/// rest_length 0 take a ZeroLengthSpring, which is finite everywhere.
/// Conserves: momentum, angular momentum, energy.
struct Spring {
  static constexpr const char* name = "spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness", "rest_length"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T length = d.norm();
    const T tension = stiffness * (length - rest_length);
    return T(tension / length) * d;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T extension = d.norm() - rest_length;
    return T(0.5) * stiffness * extension * extension;
  }

  /// Along d; across it the stiffness is k (1 - L/|d|) < k.
  static double stiffness(double k, double) { return k; }

  /// At length 0 the force turns round, but for L = 0.
  template <int D>
  static Vector<double, D> kink(const Positions<D, 2>& x, double, double rest_length) {
    if (rest_length == 0) return Vector<double, D>::Constant(std::numeric_limits<double>::infinity());
    return x[1] - x[0];
  }
};

extern template RecordedLaw record_law<Spring>(int);  // recorded in src/forces

}  // namespace jetlag
