// SPDX-License-Identifier: MIT
// Subcycling: the scheme of 1979, and what it promises of that of 1989.
#include "jetlag/schedule/subcycling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "schedule/subcycling/subcycling_for_tests.hpp"

namespace jetlag::testing {
namespace {

// ---- the scheme --------------------------------------------------------------------------------------------

/// Accelerations of ten_masses().
std::vector<double> accelerations(const std::vector<double>& x) {
  std::vector<double> a(10, 0.0);
  for (int i = 0; i < 9; ++i) {
    const double s = x[i + 1] - x[i] - 1, f = (i % 2 == 0 ? 1.0 : 100.0) * (s + s * s * s);
    a[i] += f;
    a[i + 1] -= f;
  }
  return a;
}

/// Belytschko, Yen, Mullen (1979), written down: group A of steps h, group B of steps m h, velocities half a step ahead.
/// In a cycle B gets its acceleration and moves at constant velocity, while A makes m steps.
State<double> after_cycles(const Problem& scene, const std::vector<bool>& in_b, double h, int m, int cycles) {
  std::vector<double> d(10), v(10);
  for (int i = 0; i < 10; ++i) {
    d[i] = scene.start.position(i, 0);
    v[i] = scene.start.velocity(i, 0);
  }
  std::vector<double> a = accelerations(d);
  for (int i = 0; i < 10; ++i) v[i] -= (in_b[i] ? m * h : h) / 2 * a[i];  // half a step back
  for (int n = 0; n < cycles; ++n) {
    a = accelerations(d);
    for (int i = 0; i < 10; ++i)
      if (in_b[i]) v[i] += m * h * a[i];
    const std::vector<double> begin = d;
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < 10; ++i)
        if (in_b[i]) d[i] = begin[i] + j * h * v[i];
      a = accelerations(d);
      for (int i = 0; i < 10; ++i)
        if (!in_b[i]) {
          v[i] += h * a[i];
          d[i] += h * v[i];
        }
    }
    for (int i = 0; i < 10; ++i)
      if (in_b[i]) d[i] = begin[i] + m * h * v[i];
  }
  a = accelerations(d);
  State<double> state = scene.start;
  for (int i = 0; i < 10; ++i) {
    state.position(i, 0) = d[i];
    state.velocity(i, 0) = v[i] + (in_b[i] ? m * h : h) / 2 * a[i];
  }
  return state;
}

TEST(Subcycling, IsTheSchemeOf1979WhereRatiosAreWhole) {
  // 1000 steps round positions near 10 by up to 0.9e-15 each, some three times, at random: below 1e-13; in velocities of
  // frequencies up to sqrt(202) = 14 so much more.
  const Problem chain = ten_masses();
  const double h = 0.013;  // the limit is 2/sqrt(202) = 0.14
  for (const int m : {2, 3, 5}) {
    std::vector<bool> in_b(10);
    ParticleSteps steps(10, h);
    for (int i = 0; i < 10; ++i)
      if ((in_b[i] = i >= 6)) steps[i] = m * h;
    const int cycles = 1000 / m;
    Subcycling method(chain.system, steps);
    State<double> state = chain.start;
    ASSERT_EQ(method.run(state, cycles * m * h, {}).outcome, Outcome::success);
    const State<double> reference = after_cycles(chain, in_b, h, m, cycles);
    EXPECT_LT((state.position - reference.position).cwiseAbs().maxCoeff(), 1e-13) << m;
    EXPECT_LT((state.velocity - reference.velocity).cwiseAbs().maxCoeff(), 14e-13) << m;
    EXPECT_EQ(method.work().steps, 1u * cycles * m);
  }
}

TEST(Subcycling, IsLeapfrogWhereAllStepsAreEqual) {
  // The same impulses: 1000 steps of roundings of 1e-16 that grow by t omega = 70 at most.
  const Problem cube = spring_cube(1);
  State<double> one = cube.start, other = cube.start;
  Subcycling method(cube.system, ParticleSteps(8, 0.01));
  Lockstep leapfrog(std::make_unique<Leapfrog>(cube.system, 0.01));
  ASSERT_EQ(method.run(one, 10.0, {}).outcome, Outcome::success);
  ASSERT_EQ(leapfrog.run(other, 10.0, {}).outcome, Outcome::success);
  EXPECT_LT((one.position - other.position).norm(), 1e-11);
  EXPECT_LT((one.velocity - other.velocity).norm(), 1e-11);
  EXPECT_EQ(method.work().steps, 1000u);
  EXPECT_EQ(method.work().element_coefficients, 1001u * 28u);
}

TEST(Subcycling, ReturnsAfterWholeCyclesForthAndBack) {
  // A cycle runs backwards through the same states: 2 x 200 steps of roundings of numbers below 2.
  const Problem cube = spring_cube(4);
  ParticleSteps steps(8, 0.02);
  for (int i = 0; i < 4; ++i) steps[i] = 0.08;
  State<double> state = cube.start;
  ASSERT_EQ(Subcycling(cube.system, steps).run(state, 4.0, {}).outcome, Outcome::success);
  state.velocity = -state.velocity;
  state.time = 0;
  ASSERT_EQ(Subcycling(cube.system, steps).run(state, 4.0, {}).outcome, Outcome::success);
  EXPECT_LT((state.position - cube.start.position).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((state.velocity + cube.start.velocity).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Subcycling, HasOrderTwo) {
  // Errors against degree 20; halving all steps divides them by 4. Steps in whole and in real ratios, and one for each.
  const Problem cube = spring_cube(2);
  State<double> exact = cube.start;
  Lockstep taylor_20(taylor(cube.system, 20, std::make_unique<FixedStep>(0.05)));
  ASSERT_EQ(taylor_20.run(exact, 3.0, {}).outcome, Outcome::success);
  const double golden = std::numbers::phi;
  for (const ParticleSteps& ratios : {ParticleSteps{1, 1, 1, 1, 4, 4, 4, 4},
                                      {1, 1, 1, 2.5, 2.5, 2.5, 2.5, 1},
                                      {1, golden, 1.1, 1.7, 2.3, 3.1, std::numbers::e, 2}}) {
    std::vector<double> errors;
    for (const double h : {0.02, 0.005}) {
      ParticleSteps steps = ratios;
      for (double& step : steps) step *= h;
      State<double> state = cube.start;
      ASSERT_EQ(Subcycling(cube.system, steps).run(state, 3.0, {}).outcome, Outcome::success);
      errors.push_back((state.position - exact.position).norm());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]) / 2, 2.0, 0.25);
  }
}

TEST(Subcycling, FollowsForcesThatDependOnTime) {
  // x'' = cos(w t) from rest: x = (1 - cos(w t)) / w^2. Each particle is leapfrog at its step, whose sum of impulses is
  // x (h w / 2 / sin(h w / 2))^2 at its bars: an error of x (h w)^2 / 12.
  System<double> system(1, {1.0, 1.0});
  const double w = 3, h = 0.01;
  system.add<Shaker>({{0}, {1}}, {{w}});
  State<double> state{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Zero(2, 1)};
  ASSERT_EQ(Subcycling(system, {h, 2.5 * h}).run(state, 1.0, {}).outcome, Outcome::success);
  const double x = (1 - std::cos(w)) / (w * w);
  for (const int i : {0, 1}) {
    const double q = (i == 0 ? 1.0 : 2.5) * h * w;
    EXPECT_NEAR(state.position(i, 0) / x - 1, q * q / 12, 0.01 * q * q / 12);
  }
}

}  // namespace
}  // namespace jetlag::testing
