// SPDX-License-Identifier: MIT
#pragma once
// Chains for subcycling, and the map of one cycle.

#include "jetlag/schedule/subcycling.hpp"
#include "schedule/avi/avi_for_tests.hpp"

namespace jetlag::testing {

/// Steps of wall-100-A-1-B-1-wall: h for A, r h for B.
inline ParticleSteps coarse_b(double h, double r) { return {h, h, r * h, h}; }

/// The largest |eigenvalue| of the map of `fine` steps h of A, in which B has made a whole number of its own.
inline double cycle_radius(const Scene& chain, const ParticleSteps& steps, double h, int fine) {
  return spectral_radius(chain, [&] { return Subcycling(chain.system, steps); }, fine * h);
}

/// Wall, springs of the given stiffnesses with unit masses between them, wall; at rest.
inline Scene chain_between_walls(const std::vector<double>& stiffness) {
  const int n = static_cast<int>(stiffness.size()) + 1;
  System<double> system(1, std::vector<double>(n, 1.0));
  system.fix(0);
  system.fix(n - 1);
  Scene scene{std::move(system), {0.0, Coordinates<double>(n, 1), Coordinates<double>::Zero(n, 1)}};
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < n; ++i) {
    scene.start.position(i, 0) = i;
    if (i + 1 == n) continue;
    pairs.push_back({i, i + 1});
    springs.push_back({stiffness[i], 1.0});
  }
  scene.system.add<Spring>(pairs, springs);
  return scene;
}

}  // namespace jetlag::testing
