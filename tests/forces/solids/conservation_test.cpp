// SPDX-License-Identifier: MIT
// What free bodies keep: momenta order by order and over long runs, energy as far as the method goes; what viscosity takes.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "forces/order_by_order.hpp"
#include "forces/solids/bodies.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "support/random.hpp"

namespace jetlag::testing::conservation_test {
using namespace solids;

namespace {

using Eigen::RowVector3d;

// ---- order by order ----------------------------------------------------------------------------------------

/// A cube of eight cells, moved and in motion at random.
template <class L>
void expect_momentum_of_cube() {
  SCOPED_TRACE(L::name);
  const auto mesh = jetlag::box({1, 1, 1}, {2, 2, 2});
  Uniform draw(17);
  std::vector<double> mass(27);
  for (double& m : mass) m = draw(0.5, 2);
  System<double> system(3, mass);
  system.add_at_rest<L>(mesh.tetrahedra, mesh.position, {{3.0, 2.0}});
  State<double> state{0.0, mesh.position, Coordinates<double>(27, 3)};
  for (int i = 0; i < 27 * 3; ++i) {
    state.position.data()[i] += draw(-0.05, 0.05);
    state.velocity.data()[i] = draw(-0.1, 0.1);
  }
  expect_momentum_by_order(system, state);
}
TEST(Momentum, VanishesInEachOrder) {
  for_each_elastic_law([]<class L>(std::type_identity<L>) { expect_momentum_of_cube<L>(); });
  expect_momentum_of_cube<KelvinVoigt>();
}

// ---- over long runs ----------------------------------------------------------------------------------------

struct Body {
  System<double> system;
  State<double> start;
};

/// A bar of .2 m x .2 m x .6 m that flies, spins and is bent.
Body spinning_bar() {
  const auto mesh = jetlag::box({0.2, 0.2, 0.6}, {2, 2, 6});
  Body bar{System<double>(3, lumped_masses(mesh.position, mesh.tetrahedra, density)),
           {0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)}};
  const auto [lambda, mu] = lame(young, poisson);
  bar.system.add_at_rest<NeoHookean>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
  for (int i = 0; i < mesh.position.rows(); ++i) {
    const RowVector3d r = RowVector3d(mesh.position.row(i)) - RowVector3d(0.1, 0.1, 0.3);
    bar.start.velocity.row(i) =
        RowVector3d(3, 1, 2).cross(r) + RowVector3d(0.5 * r[2] * r[2] + 0.1, 0.2, 0.3 - r[2]);
  }
  return bar;
}
State<double> moved(const Body& body, int degree, double step, double until) {
  ParticleTaylorOptions<double> options;
  options.degree = degree;
  options.step = step;
  options.compensated = false;
  State<double> state = body.start;
  const auto report = ParticleTaylor<double>(body.system, options).run(state, until);
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  return state;
}

TEST(SpinningBar, BeginsWithTheseMomentaAndThisEnergy) {  // given to their digits
  const auto bar = spinning_bar();
  EXPECT_NEAR(momentum(bar.system, bar.start).norm(), 9.088916, 1e-6);
  EXPECT_NEAR((angular_momentum(bar.system, bar.start) - Eigen::Vector3d(1.84, 0.914, 0.602)).norm(), 0,
              1e-3);
  EXPECT_NEAR(EnergyMeter{Model<double>(bar.system)}(bar.start).total(), 6.72375, 1e-5);
}

/// 2000 steps round each of 63 velocities by 2^-53, at random: some 5e-15 and less. Measured: 1e-15, 3e-15; of the energy
/// -1.27e-13, which is the truncation of degree 12.
TEST(SpinningBar, KeepsMomentaAndEnergy) {
  const auto bar = spinning_bar();
  const auto end = moved(bar, 12, 2e-3, 4.0);
  const auto drift = [&](auto of) {
    return (of(bar.system, end) - of(bar.system, bar.start)).norm() / of(bar.system, bar.start).norm();
  };
  EXPECT_LE(drift(momentum), 1e-14);
  EXPECT_LE(drift(angular_momentum), 2e-14);
  EnergyMeter energy{Model<double>(bar.system)};
  const double begun = energy(bar.start).total();
  EXPECT_NEAR(energy(end).total() / begun, 1, 2e-13);
}

TEST(SpinningBar, IsMovedByTheOrderOfTheMethod) {
  const auto bar = spinning_bar();
  constexpr double until = 0.064;
  const auto truth = moved(bar, 18, 1e-3, until);
  for (const int degree : {4, 6, 8}) {
    const auto error = [&](double step) {
      return (moved(bar, degree, step, until).position - truth.position).rowwise().norm().maxCoeff();
    };
    const double fine = error(1e-3), coarse = error(2e-3), slope = std::log2(coarse / fine);
    EXPECT_GE(slope, degree - 0.35) << degree;  // not yet in its limit, measured: 3.77, 5.75, 7.73
    EXPECT_LE(slope, degree + 0.1) << degree;
  }
}

// ---- viscosity ---------------------------------------------------------------------------------------------

TEST(KelvinVoigt, TakesEnergyInEveryStepAndNoMomentum) {
  const auto mesh = jetlag::box({0.2, 0.2, 0.4}, {2, 2, 4});
  Body bar{System<double>(3, lumped_masses(mesh.position, mesh.tetrahedra, density)),
           {0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)}};
  const auto [lambda, mu] = lame(young, poisson);
  constexpr double time = 1e-3;  // [s]
  bar.system.add_at_rest<Stvk>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
  bar.system.add_at_rest<jetlag::KelvinVoigt>(mesh.tetrahedra, mesh.position, {{time * lambda, time * mu}});
  for (int i = 0; i < mesh.position.rows(); ++i) {
    const RowVector3d q = RowVector3d(mesh.position.row(i)) - RowVector3d(0.1, 0.1, 0.2);
    bar.start.position.row(i) += RowVector3d(0.2 * q[0], 0, 0.1 * q[2]);
    bar.start.velocity.row(i) = RowVector3d(3, 1, 2).cross(q) + RowVector3d(q[2], 0, -2 * q[2]);
  }
  EnergyMeter energy{Model<double>(bar.system)};
  double last = energy(bar.start).total();
  EXPECT_NEAR(last, 87.852564, 1e-6);
  const auto turning = angular_momentum(bar.system, bar.start);
  // Truncation takes angular momentum by h^8: 4e-7 of it for h = 2.5 ms, 4e-13 for 0.4 ms, rounding 750 times 2^-53.
  constexpr int steps = 750;
  for (int n = 1; n <= steps; ++n) {
    bar.start = moved(bar, 8, 4e-4, 0.3 * n / steps);
    const double now = energy(bar.start).total();
    EXPECT_LT(now, last) << "step " << n;
    last = now;
  }
  EXPECT_NEAR(last, 3.218822, 1e-6);
  EXPECT_LE((angular_momentum(bar.system, bar.start) - turning).norm(), 1e-12 * turning.norm());
}

}  // namespace
}  // namespace jetlag::testing::conservation_test
