// SPDX-License-Identifier: MIT
#pragma once
// Attraction of two particles by their masses, softened at short distances.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F_0 = G m_0 m_1 d / s^3,   s = sqrt(|d|^2 + epsilon^2),   d = x_1 - x_0;   E = -G m_0 m_1 / s.
/// Source: Plummer, MNRAS 71 (1911) 460; Aarseth, MNRAS 126 (1963) 223.
/// constant G [m^3 / (kg s^2)], softening epsilon [m], > 0: particles may meet, where the force is 0.
/// Its stiffness G m_0 m_1 / epsilon^3 depends on the masses: `courant` limits go without it.
/// Conserves: momentum, angular momentum, energy.
struct SoftenedGravity {
  static constexpr const char* name = "softened_gravity";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"constant", "softening"};
  static constexpr bool unbounded = true;

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& constant, const T& softening) {
    using std::pow;
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T strength = constant * p.mass[0] * p.mass[1];
    return T(strength * pow(T(T(d.squaredNorm()) + softening * softening), -1.5)) * d;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& constant, const T& softening) {
    using std::sqrt;
    const Vector<T, D> d = p.position[1] - p.position[0];
    return -(constant * p.mass[0] * p.mass[1]) / sqrt(T(T(d.squaredNorm()) + softening * softening));
  }
};

extern template RecordedLaw record_law<SoftenedGravity>(int);  // recorded in src/forces

}  // namespace jetlag
