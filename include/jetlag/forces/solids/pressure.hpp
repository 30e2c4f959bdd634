// SPDX-License-Identifier: MIT
#pragma once
// Pressure on the faces of solids.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// A pressure from outside that follows the face:  f_i = -(p/6) (x_0 - x_2) x (x_1 - x_2), i = 0, 1, 2.
/// Participants counterclockwise as seen from outside. pressure p [Pa].   Source: the area vector of a triangle, in thirds.
/// One face has no energy, since its forces are the gradient of none. Those of all faces of a closed surface are: of p times
/// the volume inside; together they conserve momentum, angular momentum and that energy.
struct Pressure {
  static constexpr const char* name = "pressure";
  static constexpr int participants = 3;
  static constexpr bool external = true;
  static constexpr std::array dimensions{3};
  static constexpr std::array parameters{"pressure"};

  template <class T>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 3>& p, const T& pressure) {
    const Vector<T, 3> a = p.position[0] - p.position[2], b = p.position[1] - p.position[2];
    const T sixth = -(pressure / T(6.0));
    Vector<T, 3> f;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      f[axis] = sixth * (T(a[next] * b[last]) - T(a[last] * b[next]));
    }
    return {f, f, f};
  }
};

extern template RecordedLaw record_law<Pressure>(int);  // recorded in src/forces

}  // namespace jetlag
