// SPDX-License-Identifier: MIT
#pragma once
// Linear drag: the paper's air friction.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F = -c v.   coefficient c [kg/s].   Conserves: nothing.
struct Drag {
  static constexpr const char* name = "drag";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"coefficient"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& coefficient) {
    return T(-coefficient) * p.velocity[0];
  }

  static double damping(double c) { return c; }
};

extern template RecordedLaw record_law<Drag>(int);  // recorded in src/forces

}  // namespace jetlag
