// SPDX-License-Identifier: MIT
// Motions whose series end, vanish or begin with zeros: the step stays finite and the state right.
#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <limits>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::degenerate_dynamics_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Moved to `until` by degree 20, and the number of steps.
std::uint64_t move(const System<>& system, State<>& state, double until) {
  Lockstep run(taylor(system, 20, std::make_unique<JorbaZou>()));
  EXPECT_EQ(run.run(state, until, {}).outcome, Outcome::success);
  EXPECT_EQ(state.time, until);
  return run.work().steps;
}

TEST(DegenerateDynamics, FreeFallTakesOneStepHoweverLong) {
  Problem scene = free_fall();  // numbers with few digits: exact
  EXPECT_EQ(move(scene.system, scene.start, 1024.0), 1u);
  EXPECT_EQ(scene.start.position,
            (Coordinates<>{{1 - 1024 + 0.25 * 1024 * 1024, 2 + 512 - 0.125 * 1024 * 1024,
                            3 + 4096 - 4.875 * 1024 * 1024}}));
  EXPECT_EQ(scene.start.velocity, (Coordinates<>{{-1 + 512, 0.5 - 256, 4 - 9984}}));
}

TEST(DegenerateDynamics, WhatRestsStaysAtRest) {
  Problem hanging = oscillator(1.0, 0.0, 0.0), spring = dumbbell(1.0, 1.0, 1.0);
  spring.start.position(1, 0) = 1.0;  // its rest length
  for (Problem* scene : {&hanging, &spring}) {
    const State<> before = scene->start;
    EXPECT_EQ(move(scene->system, scene->start, 1e6), 1u);
    EXPECT_EQ(scene->start.position, before.position);
    EXPECT_EQ(scene->start.velocity, before.velocity);
  }
}

TEST(DegenerateDynamics, DuffingStartsFromAZeroOfItsPower) {
  // x = A cn(w t - K, k),  A^2 = sqrt(3) - 1,  w^2 = 1 + A^2,  k^2 = A^2 / (2 w^2), from x = 0 with x' = 1.
  const double amplitude = std::sqrt(std::sqrt(3.0) - 1), w = std::pow(3.0, 0.25);
  const double k = amplitude / (w * std::sqrt(2.0));
  const auto x = [&](double t) {
    return amplitude * boost::math::jacobi_cn(k, w * t - boost::math::ellint_1(k));
  };
  EXPECT_NEAR(x(1), 0.804358357540461, 1e-15);  // what heyoka gives

  System<> system(1, {1.0});
  system.add<CubicTether>({{0}}, {{}});
  FirstOrderTaylor<> first_order(
      [](const auto&, const auto& y) { return std::array{y[1], -y[0] - pow(y[0], 3.0)}; }, 2);
  State<> state{0.0, Coordinates<>{{0.0}}, Coordinates<>{{1.0}}};
  FirstOrderState<> numbers{0.0, {0.0, 1.0}};
  for (double t : {1.0, 5.0, 20.0}) {
    move(system, state, t);
    EXPECT_NEAR(state.position(0, 0), x(t), 16 * (1 + t) * eps) << t;  // the phase: some eps t
    first_order.run(numbers, t);
    EXPECT_NEAR(numbers.y[0], x(t), 16 * (1 + t) * eps) << t;
  }
}

TEST(DegenerateDynamics, FirstOrderSystemsMayEndOrRest) {  // y' = (1, 2 t, 0): t, t^2, 3
  FirstOrderTaylor<> method(
      [](const auto& t, const auto& y) { return std::array{1.0 + 0.0 * y[0], 2.0 * t, 0.0 * y[2]}; }, 3);
  FirstOrderState<> state{0.0, {0.0, 0.0, 3.0}};
  EXPECT_EQ(method.run(state, 1024.0).outcome, Outcome::success);
  EXPECT_EQ(method.work().steps, 1u);
  EXPECT_EQ(state.y, (std::vector{1024.0, 1024.0 * 1024.0, 3.0}));
}

TEST(DegenerateDynamics, CollisionsEndWithANameAndTheLastGoodState) {
  Problem scene = falling_together(1.0);
  State<> state = scene.start;
  Lockstep run(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
  const Report report = run.run(state, 2 * time_of_collision(1.0), {});
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
  // Where a step no longer changes the time, an ulp before the collision; the time itself is off by as much as the
  // energy, 1e-13 of it, and by 3/2 of that: T goes with |E|^(-3/2).
  EXPECT_NEAR(state.time, time_of_collision(1.0), 1e-12);
}

}  // namespace
}  // namespace jetlag::testing::degenerate_dynamics_test
