// SPDX-License-Identifier: MIT
#pragma once
// Whether the numbers of a state are such that a motion can go on from there.

#include "jetlag/base/outcome.hpp"
#include "jetlag/model/system.hpp"

namespace jetlag {

/// Positions [m] and velocities [m/s] beyond it have squares, and so energies, that overflow.
inline constexpr double largest_number = 1e150;

/// Whether all numbers of a state are below `largest`; otherwise `report` names the first particle with one that is not.
/// `begin`: of the step that led to the state.
bool in_range(const State<double>& state, double largest, double begin, Report& report);

/// Whether all numbers are finite; otherwise `report` names the first particle with one that is not.
/// `begin`: of the step that led to the state.
bool all_finite(const Coordinates<double>& position, const Coordinates<double>& velocity, double begin,
                Report& report);

/// Why coefficient k of a position may not be finite: of the force, or where k > 2 of its series, which the force at the
/// beginning does not depend on.
inline const char* cause_of_no_coefficient(int k) {
  return k > 2 ? "the force on it has no series there (a norm or root of what is zero?)"
               : "the force is singular there (particles that coincide?)";
}

/// The first row with an entry that is not finite; -1 where there is none.
template <class M>
int first_not_finite(const M& rows) {
  if (rows.allFinite()) return -1;
  for (int i = 0; i < rows.rows(); ++i)
    if (!rows.row(i).allFinite()) return i;
  return -1;
}

}  // namespace jetlag
