// SPDX-License-Identifier: MIT
#pragma once
// Where elements find the motion of their particles.

#include <cstddef>

namespace jetlag {

/// What elements read: one padded row a particle for each order.
template <class T>
struct MotionRows {
  const T* position;                 // coefficient k
  const T* velocity;                 // coefficient k
  std::size_t next_order;            // distance to coefficient k + 1
  T time, time_unit;                 // the coefficients of the time
  const T* position_rest = nullptr;  // what the positions of order 0 have beyond the number; none if null
};

}  // namespace jetlag
