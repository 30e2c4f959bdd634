// SPDX-License-Identifier: MIT
#pragma once
// Lengths of steps: none beyond what is left, none too short to change the time.

namespace jetlag {

/// The step to take [s]: the proposal, or the limit where that is shorter or nearly reached (no tiny last step remains).
inline double cropped(double proposal, double limit) {
  return proposal >= limit * (1.0 - 1e-9) ? limit : proposal;
}

/// Whether a step h [s] changes the time: below half of its last place (6e-8 s at 1e9 s) no step is taken.
inline bool advances(double time, double h) { return h > 0.0 && time + h != time; }

}  // namespace jetlag
