// SPDX-License-Identifier: MIT
#pragma once
// Steps for subcycling, and the map of one cycle.

#include "jetlag/schedule/subcycling.hpp"
#include "schedule/avi/avi_for_tests.hpp"

namespace jetlag::testing {

/// Steps of wall-100-A-1-B-1-wall: h for A, r h for B.
inline ParticleSteps coarse_b(double h, double r) { return {h, h, r * h, h}; }

/// The largest |eigenvalue| of the map of `fine` steps h of A, in which B has made a whole number of its own.
inline double cycle_radius(const Problem& chain, const ParticleSteps& steps, double h, int fine) {
  return spectral_radius(chain, [&] { return Subcycling(chain.system, steps); }, fine * h);
}

}  // namespace jetlag::testing
