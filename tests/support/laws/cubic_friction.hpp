// SPDX-License-Identifier: MIT
#pragma once
// A friction whose damping depends on the motion.

#include "jetlag/forces/force.hpp"

namespace jetlag::testing {

/// F = -c |v|^2 v: -dF/dv = c (|v|^2 + 2 v v^T), of eigenvalues c |v|^2 and 3 c |v|^2.
struct CubicFriction {
  static constexpr const char* name = "cubic friction";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& c) {
    return T(-c * p.velocity[0].squaredNorm()) * p.velocity[0];
  }
};

}  // namespace jetlag::testing
