// SPDX-License-Identifier: MIT
#pragma once
// The same acceleration everywhere, such as gravity near the ground.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F = m g;   E = -m g . x.
/// acceleration g [m/s^2]; in D dimensions its first D components.   Conserves: energy.
struct UniformField {
  static constexpr const char* name = "uniform_field";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"acceleration_x", "acceleration_y", "acceleration_z"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& x, const T& y, const T& z) {
    return p.mass[0] * field<T, D>(x, y, z);
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& x, const T& y, const T& z) {
    return -(p.mass[0] * field<T, D>(x, y, z).dot(p.position[0]));
  }

 private:
  template <class T, int D>
  static Vector<T, D> field(const T& x, const T& y, const T& z) {
    const std::array<T, 3> g{x, y, z};
    return Vector<T, D>(Vector<T, D>::Map(g.data()));
  }
};

extern template RecordedLaw record_law<UniformField>(int);  // recorded in src/forces

}  // namespace jetlag
