// SPDX-License-Identifier: MIT
#pragma once
// Chains for the asynchronous variational integrator, and the map of one period of their clocks.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "jetlag/schedule/avi.hpp"
#include "support/eigenvalues.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {

/// Wall, a spring of 100, a unit mass, a spring of 1, a unit mass, a spring of 1, wall; at rest.
inline Problem wall_chain() { return chain_between_walls({100.0, 1.0, 1.0}); }

/// Its steps: h for the stiff spring, r h for the soft ones.
inline ElementSteps wall_chain_steps(double h, double r) { return {{h, r * h, r * h}}; }

/// The largest |eigenvalue| of the map of a time `period` on (x_1, x_2 .., v_1, v_2 ..) of the particles but the first and
/// the last, measured column by column: the motion is linear, so that displacements of 0.1 tell it to rounding. make():
/// a schedule for the chain.
template <class Make>
double spectral_radius(const Problem& chain, const Make& make, double period) {
  constexpr double size = 0.1;
  const int n = chain.system.particles() - 2;
  Eigen::MatrixXd map(2 * n, 2 * n);
  for (int column = 0; column < 2 * n; ++column) {
    State<double> state = chain.start;
    (column < n ? state.position : state.velocity)(1 + column % n, 0) += size;
    if (make().run(state, period, {}).outcome != Outcome::success) return std::nan("");
    map.col(column) << (state.position - chain.start.position).middleRows(1, n),
        state.velocity.middleRows(1, n);
  }
  return spectral_radius(map / size);
}

/// The step between `stable` and `unstable` where radius(step) leaves 1. It does so as the root of the distance, by some
/// 0.7 sqrt(h - edge) in these chains: a radius of 1 + 1e-6 tells the edge to 1e-11, and eigenvalues about to part are
/// computed to the root of rounding, 1e-8.
template <class Radius>
double edge_of_stability(double stable, double unstable, const Radius& radius) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (radius(middle) > 1 + 1e-6 ? unstable : stable) = middle;
  }
  return unstable;
}

inline double spectral_radius(const Problem& chain, const ElementSteps& steps, double period) {
  return spectral_radius(chain, [&] { return Avi(chain.system, steps); }, period);
}

}  // namespace jetlag::testing
