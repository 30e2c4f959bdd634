// SPDX-License-Identifier: MIT
#pragma once
// Chains for the asynchronous variational integrator, and the map of one period of their clocks.

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "jetlag/schedule/avi.hpp"
#include "support/scenes_for_tests.hpp"

namespace jetlag::testing {

/// V = k (s^2/2 + s^4/4) of a spring of rest length 1 with extension s.
struct Hardening {
  static constexpr const char* name = "hardening spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  static constexpr int stiffness_parameter = 0;  // at rest length

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T length = d.norm(), s = length - 1.0;
    return T(stiffness * (s + s * s * s) / length) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.norm() - 1.0, square = s * s;
    return stiffness * (0.5 * square + 0.25 * square * square);
  }
};

/// Ten free unit masses on a line, hardening springs of 1 and 100 in turn, velocities 0.1 sin(1 + i^2) shifted to the
/// mean 0.05. Energy 0.040064470729897.
inline Scene ten_masses() {
  System<double> system(1, std::vector<double>(10, 1.0));
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i < 9; ++i) {
    pairs.push_back({i, i + 1});
    stiffness.push_back({i % 2 == 0 ? 1.0 : 100.0});
  }
  system.add<Hardening>(pairs, stiffness);
  Scene scene{std::move(system), {0.0, Coordinates<double>(10, 1), Coordinates<double>(10, 1)}};
  for (int i = 0; i < 10; ++i) {
    scene.start.position(i, 0) = i;
    scene.start.velocity(i, 0) = 0.1 * std::sin(1.0 + i * i);
  }
  scene.start.velocity.array() += 0.05 - scene.start.velocity.mean();
  return scene;
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
