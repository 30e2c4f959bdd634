// SPDX-License-Identifier: MIT
#pragma once
// Chains for the asynchronous variational integrator, and the map of one period of their clocks.

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "jetlag/schedule/avi.hpp"
#include "studies/ten_masses.hpp"
#include "support/scenes_for_tests.hpp"

namespace jetlag::testing {

/// The chain of ten of methods 8.
inline Scene ten_masses() {
  TenMasses chain;
  return {std::move(chain.system), std::move(chain.start)};
}

/// Wall, a spring of 100, a unit mass, a spring of 1, a unit mass, a spring of 1, wall; at rest.
inline Scene wall_chain() {
  System<double> system(1, std::vector<double>(4, 1.0));
  system.fix(0);
  system.fix(3);
  system.add<Spring>({{0, 1}, {1, 2}, {2, 3}}, {{100.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}});
  Scene scene{std::move(system), {0.0, Coordinates<double>(4, 1), Coordinates<double>::Zero(4, 1)}};
  for (int i = 0; i < 4; ++i) scene.start.position(i, 0) = i;
  return scene;
}

/// Its steps: h for the stiff spring, r h for the soft ones.
inline ElementSteps wall_chain_steps(double h, double r) { return {{h, r * h, r * h}}; }

/// The largest |eigenvalue| of the map of a time `period` on (x_1, x_2 .., v_1, v_2 ..) of the particles but the first and
/// the last, measured column by column: the motion is linear, so that displacements of 0.1 tell it to rounding. make():
/// a schedule for the chain.
template <class Make>
double spectral_radius(const Scene& chain, const Make& make, double period) {
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
  return (map / size).eigenvalues().cwiseAbs().maxCoeff();
}
inline double spectral_radius(const Scene& chain, const ElementSteps& steps, double period) {
  return spectral_radius(chain, [&] { return Avi(chain.system, steps); }, period);
}

}  // namespace jetlag::testing
