// SPDX-License-Identifier: MIT
// Energy, momentum and angular momentum, against sums made by hand.

#include "jetlag/model/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::energy_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Three particles in space at the corners of a 3-4-5 triangle, masses 1, 2, 4.
State<double> triangle() {
  State<double> state{0.0, Coordinates<double>(3, 3), Coordinates<double>(3, 3)};
  state.position << 0, 0, 0,  //
      3, 0, 0,                //
      3, 4, 0;
  state.velocity << 1, 2, 2,  //
      0, -1, 0,               //
      0.5, 0, -0.5;
  return state;
}
System<double> three_masses() { return System<double>(3, {1.0, 2.0, 4.0}); }

TEST(EnergyMeter, AddsHalfMassTimesSquaredSpeed) {
  const Energy e = EnergyMeter(three_masses())(triangle());
  EXPECT_EQ(e.kinetic, 0.5 * 1 * 9 + 0.5 * 2 * 1 + 0.5 * 4 * 0.5);
  EXPECT_EQ(e.potential, 0.0);
  EXPECT_EQ(e.total(), e.kinetic);
}

TEST(EnergyMeter, AddsThePotentialsOfAllLawsThatHaveOne) {
  System<double> system = three_masses();
  system.add<Spring>({{0, 1}, {1, 2}, {2, 0}}, {{10.0, 1.0}, {20.0, 6.0}, {30.0, 5.0}});
  system.add<Gravity>({{0, 1}, {2, 1}}, {{6.0}});
  system.add<UniformField>({{0}, {1}, {2}}, {{0.5, -8.0, 7.0}});
  system.add<Drag>({{0}, {1}, {2}}, {{100.0}});  // has no energy
  const double springs = 0.5 * 10 * 4 + 0.5 * 20 * 4 + 0.0;
  const double gravity = -6.0 * 1 * 2 / 3 - 6.0 * 4 * 2 / 4;
  const double field = -(2 * 0.5 * 3) - 4 * (0.5 * 3 - 8.0 * 4);
  // A dozen roundings of terms below 130.
  EXPECT_NEAR(EnergyMeter(system)(triangle()).potential, springs + gravity + field, 12 * 130 * eps);
}

TEST(EnergyMeter, CountsEveryElementOnceWhateverTheLanes) {
  // 1 .. 70 springs of energy 1/2 each: blocks that are full, and blocks that are not.
  for (int n : {1, 2, 7, 8, 31, 32, 33, 64, 70}) {
    System<double> system(2, {1.0, 1.0});
    system.add<Spring>(std::vector<std::array<int, 2>>(n, {0, 1}), {{1.0, 1.0}});
    State<double> state{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
    state.position(1, 1) = 2.0;
    EXPECT_EQ(EnergyMeter(system)(state).potential, 0.5 * n);
  }
}

TEST(EnergyMeter, IsMinusOneHalfForThePlanetOfUnitAxis) {
  for (double e : {0.0, 0.3, 0.9}) {
    const auto scene = planet(e);
    // v^2/2 - 1/(1-e): both of size 1/(1-e), each with a few roundings.
    EXPECT_NEAR(EnergyMeter(scene.system)(scene.start).total(), -0.5, 4 * eps / (1 - e));
  }
}

TEST(Momentum, AddsMassTimesVelocity) {
  const Eigen::VectorXd p = momentum(three_masses(), triangle());
  EXPECT_EQ(p, Eigen::Vector3d(1 + 0 + 2, 2 - 2 + 0, 2 + 0 - 2));
}

TEST(AngularMomentum, AddsMassTimesPositionCrossVelocityInSpace) {
  const Eigen::VectorXd l = angular_momentum(three_masses(), triangle());
  // particle 1: 2 (3,0,0) x (0,-1,0) = (0, 0, -6);  particle 2: 4 (3,4,0) x (.5,0,-.5) = 4 (-2, 1.5, -2).
  EXPECT_EQ(l, Eigen::Vector3d(-8, 6, -14));
}

TEST(AngularMomentum, IsOneNumberInThePlaneAndNoneOnALine) {
  const Problem round = planet(0.6);
  const Eigen::VectorXd l = angular_momentum(round.system, round.start);
  ASSERT_EQ(l.size(), 1);
  EXPECT_NEAR(l[0], 0.8, 2 * eps);  // sqrt(1 - e^2)
  const Problem line = oscillator();
  EXPECT_EQ(angular_momentum(line.system, line.start).size(), 0);
}

}  // namespace
}  // namespace jetlag::testing::energy_test
