// SPDX-License-Identifier: MIT
// The symplectic Euler method: what it is beyond the laws of all integrators.

#include "jetlag/integrators/explicit/symplectic_euler.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "jetlag/forces/drag.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::symplectic_euler_test {
namespace {

State<double> after(const Problem& scene, double step, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(Lockstep(std::make_unique<SymplecticEuler>(scene.system, step)).run(state, until, {}).outcome,
            Outcome::success);
  return state;
}

TEST(SymplecticEuler, ConservesItsModifiedOscillatorEnergy) {
  // For x'' = -x it keeps x^2 + v^2 - h x v exactly.
  const double h = 0.5, eps = std::numeric_limits<double>::epsilon();
  const auto modified = [&](const State<double>& s) {
    const double x = s.position(0, 0), v = s.velocity(0, 0);
    return x * x + v * v - h * x * v;
  };
  const Problem scene = oscillator(1.0, 1.0, 0.5);
  EXPECT_NEAR(modified(after(scene, h, 1000.0)), modified(scene.start),
              2000 * 4 * eps);  // roundings of 2000 steps
}

TEST(SymplecticEuler, KeepsMomentumAndAngularMomentumOfANetwork) {
  const Problem scene = spring_cube(1);
  const State<double> end = after(scene, 0.0625, 100.0);
  // Kicks along the springs, drifts along the velocities: rounding alone.
  EXPECT_LT((momentum(scene.system, end) - momentum(scene.system, scene.start)).norm(), 1e-13) << "seed 1";
  EXPECT_LT((angular_momentum(scene.system, end) - angular_momentum(scene.system, scene.start)).norm(), 1e-12)
      << "seed 1";
}

TEST(SymplecticEuler, EvaluatesForcesOnceAStep) {
  const Problem scene = spring_cube(2);
  Lockstep lockstep(std::make_unique<SymplecticEuler>(scene.system, 0.125));
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 10.0, {}).outcome, Outcome::success);
  EXPECT_EQ(lockstep.work().element_coefficients, 28u * 80);
  EXPECT_EQ(lockstep.work().coefficients, 8u * 80);
}

TEST(SymplecticEuler, RefusesDragAndStepsThatAreNotPositive) {
  Problem scene = oscillator();
  EXPECT_THROW(SymplecticEuler(scene.system, 0.0), std::invalid_argument);
  scene.system.add<Drag>({{0}}, {{0.5}});
  EXPECT_THROW(SymplecticEuler(scene.system, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::symplectic_euler_test
