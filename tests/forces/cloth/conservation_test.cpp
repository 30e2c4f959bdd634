// SPDX-License-Identifier: MIT
// What free sheets keep: nothing acts in rigid motions, momenta order by order and over long runs; and folds.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "forces/cloth/sheets.hpp"
#include "forces/order_by_order.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "support/random.hpp"

namespace jetlag::testing::cloth_conservation_test {
using namespace cloth;

namespace {

using Eigen::RowVector3d;

Mesh cloth_mesh() { return sheet({0.4, 0.1 * std::sqrt(12.0)}, {4, 4}, SheetPattern::equilateral); }

template <class F>
void for_each_law_of_bending(F f) {
  f(std::type_identity<Bending>{});
  f(std::type_identity<Hinge>{});
}

/// Moved as a whole, cloth at rest stays so: forces are sums of rounded differences of E t |d|^3 / d^2 = 10 N of membranes, and
/// hinges of angles that are rounded by 2^-53 of a turn times 1e-3 N m / 0.1 m: 1e-13 of the former.
template <class L>
void expect_rest_anywhere() {
  SCOPED_TRACE(L::name);
  const Mesh mesh = cloth_mesh();
  const System<double> system = cloth_of<L>(mesh, 1e-3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  Coordinates<double> moved = mesh.position * turn.transpose();
  moved.rowwise() += RowVector3d(0.3, -0.2, 0.5);
  EXPECT_LE(forces_at(system, moved).cwiseAbs().maxCoeff(), 1e-13 * young * thickness * 0.1);
}
TEST(Cloth, StaysAtRestWhereverItIs) {
  for_each_law_of_bending([]<class L>(std::type_identity<L>) { expect_rest_anywhere<L>(); });
}

/// A cylinder of curvature 2/m, and a hinge at each of its edges that wants it so.
TEST(Hinge, StaysCurvedAsItWasAtRest) {
  Mesh mesh = cloth_mesh();
  for (int i = 0; i < mesh.position.rows(); ++i) {
    const double angle = 2 * mesh.position(i, 0);
    mesh.position.row(i) = RowVector3d(std::sin(angle) / 2, mesh.position(i, 1), (1 - std::cos(angle)) / 2);
  }
  System<double> curved(3, std::vector<double>(mesh.position.rows(), 1.0)), flat = curved;
  curved.add_at_rest<Hinge>(hinges_of(mesh.triangles), mesh.position, {{1.0, 1.0}});
  flat.add_at_rest<Hinge>(hinges_of(mesh.triangles), mesh.position, {{1.0, 0.0}});
  // Angles near 0.2 are those of rest to rounding, some 10 of them over heights of 0.1 m.
  EXPECT_LE(forces_at(curved, mesh.position).cwiseAbs().maxCoeff(), 100 * 0x1p-53);
  EXPECT_GE(forces_at(flat, mesh.position).cwiseAbs().maxCoeff(), 0.1);
}

template <class L>
void expect_momentum_of_cloth() {
  SCOPED_TRACE(L::name);
  const Mesh mesh = cloth_mesh();
  const System<double> system = cloth_of<L>(mesh, 1e-3);
  Uniform draw(17);
  State<double> state{0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)};
  for (int i = 0; i < state.position.size(); ++i) {
    state.position.data()[i] += draw(-0.005, 0.005);
    state.velocity.data()[i] = draw(-0.1, 0.1);
  }
  expect_momentum_by_order(system, state);
}
TEST(Cloth, HasNoMomentumInAnyOrder) {
  for_each_law_of_bending([]<class L>(std::type_identity<L>) { expect_momentum_of_cloth<L>(); });
}

State<double> moved(const System<double>& system, State<double> state, int degree, double step,
                    double until) {
  ParticleTaylorOptions<double> options;
  options.degree = degree;
  options.step = step;
  options.compensated = false;
  const auto report = ParticleTaylor<double>(system, options).run(state, until);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  return state;
}

/// A free sheet that spins, flies and is bent, over 500 steps: momenta to rounding, which is 2^-53 a step of 25 particles, at
/// random; energy to the truncation of degree 16.
template <class L>
void expect_flight() {
  SCOPED_TRACE(L::name);
  const Mesh mesh = cloth_mesh();
  const System<double> system = cloth_of<L>(mesh, 0);
  State<double> state{0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)};
  for (int i = 0; i < mesh.position.rows(); ++i) {
    const RowVector3d r = RowVector3d(mesh.position.row(i)) - RowVector3d(0.2, 0.17, 0);
    state.velocity.row(i) = RowVector3d(3, 1, 2).cross(r) + RowVector3d(0.1, 0.2, 0.3 + 5 * r[0] * r[1]);
  }
  const State<double> end = moved(system, state, 16, 1e-3, 0.5);
  const auto drift = [&](auto of) {
    return (of(system, end) - of(system, state)).norm() / of(system, state).norm();
  };
  EXPECT_LE(drift(momentum), 1e-14);
  EXPECT_LE(drift(angular_momentum), 2e-14);
  EnergyMeter energy{Model<double>(system)};
  EXPECT_NEAR(energy(end).total() / energy(state).total(), 1, 1e-12);
  EXPECT_GT(energy(end).potential, 1e-3 * energy(end).total());  // it is not idle
}
TEST(Cloth, KeepsMomentaAndEnergyInFlight) {
  for_each_law_of_bending([]<class L>(std::type_identity<L>) { expect_flight<L>(); });
}

TEST(Cloth, LosesEnergyByViscosityButNoMomentum) {
  const Mesh mesh = cloth_mesh();
  const System<double> system = cloth_of<Bending>(mesh, 1e-3);
  State<double> state{0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)};
  for (int i = 0; i < mesh.position.rows(); ++i) {
    const RowVector3d r = RowVector3d(mesh.position.row(i)) - RowVector3d(0.2, 0.17, 0);
    state.velocity.row(i) = RowVector3d(3, 1, 2).cross(r) + RowVector3d(2 * r[0], -r[1], 0);
  }
  EnergyMeter energy{Model<double>(system)};
  const auto turning = angular_momentum(system, state);
  double last = energy(state).total();
  for (int n = 1; n <= 20; ++n) {
    state = moved(system, state, 12, 1e-4, 1e-3 * n);
    const double now = energy(state).total();
    EXPECT_LT(now, last) << n;
    last = now;
  }
  EXPECT_LE((angular_momentum(system, state) - turning).norm(), 1e-12 * turning.norm());
}

}  // namespace
}  // namespace jetlag::testing::cloth_conservation_test
