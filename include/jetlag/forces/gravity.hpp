// SPDX-License-Identifier: MIT
#pragma once
// Newtonian attraction between two particles.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F_0 = G m_0 m_1 d / |d|^3,   d = x_1 - x_0;   E = -G m_0 m_1 / |d|.         Source: Newton.
/// constant G [m^3 / (kg s^2)].   Range: d != 0. There the force is not finite, that of
/// SoftenedGravity is.
/// Its stiffness 2 G m_0 m_1 / |d|^3 grows as they come together: `courant` limits go without it.
/// Conserves: momentum, angular momentum, energy.
struct Gravity {
  static constexpr const char* name = "gravity";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"constant"};
  static constexpr int unrolled_orders = 20;
  static constexpr std::array unrolled_dimensions{2, 3};
  static constexpr bool unbounded = true;

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& constant) {
    using std::pow;
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T strength = constant * p.mass[0] * p.mass[1];
    return T(strength * pow(T(d.squaredNorm()), -1.5)) * d;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& constant) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return -(constant * p.mass[0] * p.mass[1]) / d.norm();
  }
};

extern template RecordedLaw record_law<Gravity>(int);  // recorded in src/forces

}  // namespace jetlag
