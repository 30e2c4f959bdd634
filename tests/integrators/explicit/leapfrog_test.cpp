// SPDX-License-Identifier: MIT
// Leapfrog: what it is beyond the laws of all integrators.

#include "jetlag/integrators/explicit/leapfrog.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "jetlag/forces/drag.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::leapfrog_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

State<double> after(const Problem& scene, double step, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(Lockstep(std::make_unique<Leapfrog>(scene.system, step)).run(state, until, {}).outcome,
            Outcome::success);
  return state;
}

TEST(Leapfrog, ConservesItsModifiedOscillatorEnergy) {
  // For x'' = -x leapfrog keeps v^2 + (1 - h^2/4) x^2 exactly.
  const double h = 0.5;
  const auto modified = [&](const State<double>& s) {
    return std::pow(s.velocity(0, 0), 2) + (1 - h * h / 4) * std::pow(s.position(0, 0), 2);
  };
  const Problem scene = oscillator(1.0, 1.0, 0.5);
  const State<double> end = after(scene, h, 1000.0);
  EXPECT_NEAR(modified(end), modified(scene.start), 2000 * 4 * eps);  // 2000 steps of a few roundings
}

TEST(Leapfrog, TurnsAnOscillatorByItsDiscreteAngle) {
  // x_n = cos(n theta), cos theta = 1 - h^2/2, from x = 1 and v = 0.
  const double h = 0.5, theta = std::acos(1 - h * h / 2);
  for (int n : {1, 2, 17, 100})
    EXPECT_NEAR(after(oscillator(), h, n * h).position(0, 0), std::cos(n * theta), n * 8 * eps);
}

TEST(Leapfrog, KeepsMomentumAndAngularMomentumOfANetwork) {
  const Problem scene = spring_cube(1);
  const State<double> end = after(scene, 0.0625, 100.0);
  // Kicks along the springs at fixed positions, drifts along the velocities: rounding alone.
  EXPECT_LT((momentum(scene.system, end) - momentum(scene.system, scene.start)).norm(), 1e-13) << "seed 1";
  EXPECT_LT((angular_momentum(scene.system, end) - angular_momentum(scene.system, scene.start)).norm(), 1e-12)
      << "seed 1";
}

TEST(Leapfrog, EvaluatesForcesOnceAStep) {
  // And once before the first. 0.1 is no binary fraction: the clock's compensation must not cost evaluations.
  for (double step : {0.125, 0.1}) {
    const Problem scene = spring_cube(2);
    Lockstep lockstep(std::make_unique<Leapfrog>(scene.system, step));
    State<double> state = scene.start;
    ASSERT_EQ(lockstep.run(state, 1000 * step, {}).outcome, Outcome::success);
    EXPECT_EQ(lockstep.work().steps, 1000u);
    EXPECT_EQ(lockstep.work().element_coefficients, 28u * 1001);
    EXPECT_EQ(lockstep.work().coefficients, 8u * 1000);
  }
}

TEST(Leapfrog, EvaluatesForcesTwiceAStepWhereTheyDependOnVelocity) {
  Problem scene = oscillator();
  scene.system.add<Drag>({{0}}, {{0.5}});
  Lockstep lockstep(std::make_unique<Leapfrog>(scene.system, 0.125));
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 10.0, {}).outcome, Outcome::success);
  EXPECT_EQ(lockstep.work().element_coefficients, 2u * 2 * 80);
}

TEST(Leapfrog, RemembersNoForceOfAnotherTimeOrPlace) {
  // The state is moved by hand between steps: the second step is that of an integrator that has seen nothing.
  Problem scene = oscillator(1.0, 0.5, 0.25);
  scene.system.add<Shaker>({{0}}, {{3.0}});
  for (auto [x, t] : {std::pair(0.0, 1.0), std::pair(0.125, 0.0), std::pair(0.0, 0.0)}) {
    Leapfrog used(scene.system, 0.25), fresh(scene.system, 0.25);
    State<double> state = scene.start;
    Report report;
    used.step(state, 1.0, report);
    state.time += 0.25 + t;
    state.position(0, 0) += x;
    State<double> expected = state;
    used.step(state, 1.0, report);
    fresh.step(expected, 1.0, report);
    EXPECT_EQ(state.position, expected.position);
    EXPECT_EQ(state.velocity, expected.velocity);
  }
}

TEST(Leapfrog, IsOfOrderTwoWithDragAndWithForcesThatDependOnTime) {
  // x'' = -c x' and x'' = cos(w t): x = v (1 - e^{-ct})/c from x = 0, and x = (1 - cos(w t))/w^2 from rest.
  Problem sliding = oscillator(0.0, 0.0, 1.0);
  sliding.system.add<Drag>({{0}}, {{0.7}});
  Problem shaken = oscillator(0.0, 0.0, 0.0);
  shaken.system.add<Shaker>({{0}}, {{3.0}});
  const auto slope = [](const Problem& scene, double truth) {
    const double coarse = after(scene, 1.0 / 16, 1.0).position(0, 0) - truth;
    const double fine = after(scene, 1.0 / 64, 1.0).position(0, 0) - truth;
    return std::log(coarse / fine) / std::log(4.0);
  };
  EXPECT_NEAR(slope(sliding, (1 - std::exp(-0.7)) / 0.7), 2.0, 0.1);  // next term: h c / ln 4
  EXPECT_NEAR(slope(shaken, (1 - std::cos(3.0)) / 9), 2.0, 0.1);
}

TEST(Leapfrog, RefusesAStepThatIsNotPositive) {
  const Problem scene = oscillator();
  for (double step : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Leapfrog(scene.system, step), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::leapfrog_test
