// SPDX-License-Identifier: MIT
// The laws of molecules: what their angles are, and that there is no cut in them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing::molecular_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Three bonds of a chain, turned by phi about the second, clockwise as one looks along it.
Coordinates<double> chain(double phi) {
  Coordinates<double> x(4, 3);
  x << 1.3, 0, -0.4, 0, 0, 0, 0, 0, 1.5, 0.8 * std::cos(phi), 0.8 * std::sin(phi), 1.9;
  return x;
}
template <class L>
double energy_of(const Coordinates<double>& x, double k, double c) {
  Participants<double, 3, L::participants> p;
  for (int i = 0; i < L::participants; ++i) p.position[i] = x.row(i);
  return L::energy(p, k, c);
}

template <int n>
void expect_torsion() {
  for (const double phi : {-3.0, -1.0, 0.0, 0.5, 2.0, pi})
    for (const double phase : {0.0, 0.7, pi})  // some 10 n roundings of numbers near 1
      EXPECT_NEAR(energy_of<Dihedral<n>>(chain(phi), 2.0, phase), 2 * (1 + std::cos(n * phi - phase)),
                  40 * n * 0x1p-53)
          << n << " phi " << phi << " phase " << phase;
}
TEST(Dihedral, HasTheEnergyOfItsMultiplicity) {
  expect_torsion<1>();
  expect_torsion<2>();
  expect_torsion<3>();
  expect_torsion<6>();
}

/// From 2.9 to beyond pi, where atan2 has its cut: the energy is kept as everywhere, to the rounding of some 10 steps.
TEST(Dihedral, GoesThroughTransWithoutNoticing) {
  System<double> system(3, {2.0, 1.0, 1.0, 2.0});
  system.add<Dihedral<3>>({{0, 1, 2, 3}}, {{2.0, 0.7}});
  State<double> state{0.0, chain(2.9), Coordinates<double>::Zero(4, 3)};
  state.velocity(3, 0) = -4 * 0.8 * std::sin(2.9);
  state.velocity(3, 1) = 4 * 0.8 * std::cos(2.9);
  EnergyMeter energy{Model<double>(system)};
  const double before = energy(state).total();
  const Report report = Lockstep(taylor(system, 16, std::make_unique<JorbaZou>(0.1))).run(state, 0.2, {});
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  EXPECT_LT(state.position(3, 1), -0.1);
  EXPECT_NEAR(energy(state).total(), before, before * 100 * 0x1p-53);
}

TEST(Angle, HasTheEnergyOfTheAngleAtItsSecondParticle) {
  for (const double phi : {0.3, 1.0, 2.0, pi}) {
    Coordinates<double> x(3, 3);
    x << 1.3, 0, 0, 0, 0, 0, 0.8 * std::cos(phi), 0.8 * std::sin(phi), 0;
    const double off = std::cos(phi) + 0.25;
    EXPECT_NEAR(energy_of<Angle>(x, 2.0, -0.25), off * off, 16 * 0x1p-53) << phi;
  }
}

/// In line the angle is at its largest: nothing bends it, and its series is finite.
TEST(Angle, HasNoSingularityInLine) {
  System<double> system(3, {2.0, 1.0, 1.0});
  system.add<Angle>({{0, 1, 2}}, {{2.0, -0.25}});
  State<double> state{0.0, Coordinates<double>(3, 3), Coordinates<double>::Zero(3, 3)};
  state.position << 1.3, 0, 0, 0, 0, 0, -0.8, 0, 0;
  Expansion<double> at_rest(system, 8), moving(system, 8);
  at_rest.start(state);
  at_rest.grow_to(8);
  EXPECT_LE(at_rest.position(2).cwiseAbs().maxCoeff(), 16 * 0x1p-53);  // of bonds that push by some 2 N
  state.velocity(2, 1) = 1.0;
  moving.start(state);
  moving.grow_to(8);
  EXPECT_TRUE(moving.position(8).allFinite());
  EXPECT_GT(moving.position(3).cwiseAbs().maxCoeff(), 0.1);
}

}  // namespace
}  // namespace jetlag::testing::molecular_test
