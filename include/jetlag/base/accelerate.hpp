// SPDX-License-Identifier: MIT
#pragma once
// From the forces to the motion.

#include <cstddef>

namespace jetlag {

/// From coefficient k of the forces F on n components, which x holds, to those of the velocities and positions,
///
///     v_{k+1} = F_k u / (m (k+1)),   x_{k+2} = F_k u^2 / (m (k+1) (k+2)),   u: the unit of time.
///
/// x then holds the positions. push: u / m of each component, 0 where it is fixed. v: null where velocities are not kept.
/// The lanes of ensembles do the same with kernels of their own (ensembles/system_lanes.cpp).
template <class T>
void accelerate(std::size_t n, int k, const T& unit, const T* push, T* x, T* v) {
  const T of_velocity = T(1) / T(k + 1), of_position = unit * (T(1) / T((k + 1) * (k + 2)));
  for (std::size_t i = 0; i < n; ++i) {
    const T change = x[i] * push[i];
    if (v != nullptr) v[i] = change * of_velocity;
    x[i] = change * of_position;
  }
}

}  // namespace jetlag
