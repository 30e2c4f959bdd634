// SPDX-License-Identifier: MIT
#pragma once
// Where a particle goes: a polynomial in time.

#include <cstddef>

namespace jetlag {

/// Where a particle goes, a view: x(s) = sum_{k<=degree} w_k c_k (s / unit)^k [m], s [s] from the beginning of the step. c_k has
/// its components beside each other, `stride` numbers after those of c_{k-1}; w_k are weights of a series that was stopped at random.
struct PathView {
  const double* c_0;
  std::ptrdiff_t stride;
  int degree;                       // N >= 0: 0 of a vertex at rest
  double unit = 1;                  // [s]
  int dimension = 3;                // 1 to 3: the others are 0
  const double* weights = nullptr;  // null: 1
};

}  // namespace jetlag
