// SPDX-License-Identifier: MIT
// Steps by an estimated error, where the estimate is rounding: none of them starves.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/gauss_radau.hpp"
#include "jetlag/integrators/explicit/hermite.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::rounding_floor_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

using Make = std::function<std::unique_ptr<Integrator>(const System<double>&)>;

Make gauss_radau(double tolerance = 1e-9) {
  return [=](const System<double>& system) {
    return std::make_unique<GaussRadau>(system, GaussRadau::Options{.tolerance = tolerance});
  };
}
Make embedded(const RungeKuttaTable& table, double tolerance = 1e-9) {
  return [=, &table](const System<double>& system) {
    return std::make_unique<RungeKutta>(system, table, EmbeddedControl{tolerance});
  };
}
Make aarseth(int iterations) {
  return [=](const System<double>& system) {
    return std::make_unique<Hermite>(system, Hermite::Options{.iterations = iterations});
  };
}

struct Method {
  std::string name;
  Make make;
};
const std::vector<Method> controlled = {{"gauss_radau", gauss_radau()},
                                        {"dopri5", embedded(dopri5())},
                                        {"dop853", embedded(dop853())},
                                        {"hermite, aarseth", aarseth(1)},
                                        {"hermite, aarseth, 3 iterations", aarseth(3)}};

struct Ending {
  Report report;
  State<double> end;
  double tries;  // steps, and those tried again
};
/// To `until`, in a number of steps that a run which starves uses up.
Ending run(const Problem& scene, const Make& make, double until) {
  Ending run{{}, scene.start, 0};
  Lockstep lockstep(make(scene.system));
  RunOptions options;
  options.max_steps = 50'000;
  run.report = lockstep.run(run.end, until, options);
  run.tries = static_cast<double>(lockstep.work().steps + lockstep.work().rejected);
  return run;
}

/// Unit masses in a row at x = offset, offset + 1, .., the first one held, springs of length 1 between them; the last
/// mass is pulled by `stretch`.
Problem row(double offset, const std::vector<double>& stiffness, double stretch) {
  const int n = static_cast<int>(stiffness.size()) + 1;
  System<double> system(1, std::vector<double>(n, 1.0));
  system.fix(0);
  Problem scene{std::move(system), {0.0, Coordinates<double>(n, 1), Coordinates<double>::Zero(n, 1)}};
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < n; ++i) {
    scene.start.position(i, 0) = offset + i;
    if (i > 0) pairs.push_back({i - 1, i});
    if (i > 0) springs.push_back({stiffness[i - 1], 1.0});
  }
  scene.start.position(n - 1, 0) += stretch;
  scene.system.add<Spring>(pairs, springs);
  return scene;
}

/// A unit mass at a spring, k = 100 and length 1, in a field, slowed down by 1/s: at rest 1.098 below.
Problem damped_pendulum() {
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Spring>({{0, 1}}, {{100.0, 1.0}});
  system.add<UniformField>({{1}}, {{0.0, -9.8}});
  system.add<Drag>({{1}}, {{1.0}});
  Problem scene{std::move(system), {0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)}};
  scene.start.position(1, 0) = 1.0;
  return scene;
}

/// Of gauss_radau in a motion of frequency w: b_6 = (w h)^7 / 7! of a, for b_6 at the tolerance.
double length_of_gauss_radau(double w, double tolerance = 1e-9) {
  return std::pow(5040 * tolerance, 1.0 / 7) / w;
}

TEST(RoundingFloor, GaussRadauTakesNoMoreStepsFarFromTheOrigin) {
  // Far away b_6 is rounding, which makes steps longer, never shorter than at the origin: 50 / 0.175 of them, and some
  // to begin with. The forces are uncertain by eps X / 2; the error of x is a random walk of h eps X / 2 a step, below
  // sqrt(50 h) eps X / 2 with h < 3, and three deviations.
  for (const double stretch : {1e-1, 1e-3, 1e-5})
    for (const double offset : {0.0, 10.0, 1e3, 1e6}) {
      const Problem scene = row(offset, {1.0}, stretch);
      const Ending result = run(scene, gauss_radau(), 50.0);
      ASSERT_EQ(result.report.outcome, Outcome::success) << offset << " " << stretch;
      EXPECT_LE(result.tries, 1.1 * 50 / length_of_gauss_radau(1.0)) << offset << " " << stretch;
      const double amplitude = scene.start.position(1, 0) - offset - 1;
      EXPECT_NEAR(result.end.position(1, 0) - offset - 1, amplitude * std::cos(50.0), 18 * eps * (offset + 2))
          << offset << " " << stretch;
    }
}

TEST(RoundingFloor, GaussRadauTakesStepsThatBelongToRoundingAtAnyTolerance) {
  // Two roundings of X = 1.1 by a half at least, 13 616 fold in b_6, against accelerations of 0.1 at most: it is never
  // asked for a b_6 below 13 616 eps 11 of a.
  for (const double tolerance : {1e-12, 1e-14, 1e-30}) {
    const Ending result = run(row(0.0, {1.0}, 0.1), gauss_radau(tolerance), 50.0);
    ASSERT_EQ(result.report.outcome, Outcome::success) << tolerance;
    EXPECT_LE(result.tries, 1.1 * 50 / length_of_gauss_radau(1.0, 13616 * 11 * eps)) << tolerance;
  }
}

TEST(RoundingFloor, GaussRadauIsHeldUpByTheFastestSpringOnly) {
  // One spring among soft ones is 10^4 times stiffer and hardly moves; its frequency is sqrt(2 10^4).
  const Ending result =
      run(row(0.0, {1.0, 1.0, 1.0, 1e4, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, 1e-3), gauss_radau(), 5.0);
  ASSERT_EQ(result.report.outcome, Outcome::success);
  EXPECT_LE(result.tries, 1.1 * 5 / length_of_gauss_radau(std::sqrt(2e4)));
}

TEST(RoundingFloor, GaussRadauFollowsASatelliteOfTheEarthAboutTheSun) {
  // 1.5e11 m from the origin and 7e6 m from the Earth, in SI units: a day, 14.8 orbits of 5829 s.
  const double sun = 1.32712440018e20, earth = 3.98589e14, far = 1.495978707e11, near = 7e6;
  System<double> system(2, {sun / 6.6743e-11, earth / 6.6743e-11, 1000.0});
  system.add<Gravity>({{0, 1}, {0, 2}, {1, 2}}, {{6.6743e-11}});
  Problem scene{std::move(system), {0.0, Coordinates<double>::Zero(3, 2), Coordinates<double>::Zero(3, 2)}};
  scene.start.position.col(0) << 0.0, far, far + near;
  scene.start.velocity.col(1) << 0.0, std::sqrt(sun / far), std::sqrt(sun / far) + std::sqrt(earth / near);
  const Ending result = run(scene, gauss_radau(), 86400.0);
  ASSERT_EQ(result.report.outcome, Outcome::success) << result.report.message;
  EXPECT_LE(result.tries, 1.1 * 86400 / length_of_gauss_radau(std::sqrt(earth / near) / near));
  // On a circle but for the tide of the sun, (near / far)^3 sun / earth = 4e-8 of the attraction.
  EXPECT_NEAR((result.end.position.row(2) - result.end.position.row(1)).norm(), near, 1e-5 * near);
}

TEST(RoundingFloor, AtRestStepsGrowToTheBorderOfStability) {
  // The velocity, at first below 5 m/s, falls as e^{-t/2} to 1e-14 in 67 s; until then there is a motion to follow,
  // with no more steps a second than in the first 20 s. After that 1 / w is stable for each of them, w = 10/s the
  // fastest frequency; steps that grow beyond and are cut back may be half of that in the mean.
  const Problem scene = damped_pendulum();
  for (const Method& method : controlled) {
    const Ending moving = run(scene, method.make, 20.0), resting = run(scene, method.make, 1000.0);
    ASSERT_EQ(moving.report.outcome, Outcome::success) << method.name << ": " << moving.report.message;
    ASSERT_EQ(resting.report.outcome, Outcome::success) << method.name << ": " << resting.report.message;
    EXPECT_LE(resting.tries, moving.tries / 20 * 67 + 2 * 10 * (1000 - 67)) << method.name;
    // 100 roundings of w X a step, and what a step beyond the border makes of them before it is seen: 100 fold.
    EXPECT_LT(resting.end.velocity.cwiseAbs().maxCoeff(), 1e4 * eps * 10 * 1.1) << method.name;
    EXPECT_NEAR(resting.end.position(1, 1), -1.098, 1e4 * eps * 1.1) << method.name;
  }
}

TEST(RoundingFloor, DragAloneBringsAParticleToRest) {
  // v = e^{-ct}, c = 100/s, falls below the least double in 7.5 s; until then there are no more steps a second than in
  // the first, and then, among roundings of the least double, steps of 1 / (4 c): 3 / c is stable.
  Problem scene = oscillator(0.0, 0.0, 1.0);
  scene.system.add<Drag>({{0}}, {{100.0}});
  for (const Method& method : controlled) {
    const Ending moving = run(scene, method.make, 1.0), resting = run(scene, method.make, 20.0);
    ASSERT_EQ(resting.report.outcome, Outcome::success) << method.name << ": " << resting.report.message;
    EXPECT_LE(resting.tries, moving.tries * 7.5 + 4 * 100 * (20 - 7.5)) << method.name;
    EXPECT_NEAR(resting.end.position(0, 0), 0.01, 1e-5) << method.name;
  }
}

TEST(RoundingFloor, NoMethodTakesMoreStepsFarFromTheOrigin) {
  // Rounding only adds to what is allowed; the other tenth is of signs and sizes of few steps.
  for (const Method& method : controlled) {
    const double near = run(row(0.0, {1.0}, 1e-3), method.make, 50.0).tries;
    for (const double offset : {10.0, 1e3, 1e6, 1e9}) {
      const Ending result = run(row(offset, {1.0}, 1e-3), method.make, 50.0);
      ASSERT_EQ(result.report.outcome, Outcome::success) << method.name << " at " << offset;
      EXPECT_LE(result.tries, 1.1 * near) << method.name << " at " << offset;
    }
  }
}

TEST(RoundingFloor, AToleranceBelowEpsilonAsksForNoMoreThanEpsilon) {
  // The error of a step is held at tolerance + eps, and h ~ (tolerance + eps)^(1/q): 1e-20 against 1e-16.
  for (const RungeKuttaTable* table : {&dopri5(), &dop853()}) {
    const Problem scene = planet(0.5);
    const Ending tight = run(scene, embedded(*table, 1e-16), 2 * std::numbers::pi),
                 tighter = run(scene, embedded(*table, 1e-20), 2 * std::numbers::pi);
    ASSERT_EQ(tighter.report.outcome, Outcome::success) << table->name;
    EXPECT_NEAR(tighter.tries / tight.tries, std::pow((1e-16 + eps) / eps, 1.0 / table->error_order), 0.03)
        << table->name;
  }
}

TEST(RoundingFloor, WhereNoStepIsLeftTheRunEnds) {
  // Two bodies that fall into each other, T = 0.56 s: each step is a 30th of what is left of it at least, until it is
  // ten roundings of the time; the time itself, a sum with its rest, is rounded by half a one.
  for (const Method& method : controlled) {
    const Problem scene = falling_together(1.0);
    State<double> state = scene.start;
    double shortest = std::numeric_limits<double>::infinity();  // in roundings of the time
    RunOptions options;
    options.max_steps = 50'000;
    options.observer.after_step = [&](const StepView& view) {
      shortest = std::min(shortest, (view.end() - view.begin()) / (eps * view.end()));
      return true;
    };
    Lockstep lockstep(method.make(scene.system));
    const Report report = lockstep.run(state, 2.0, options);
    EXPECT_EQ(report.outcome, Outcome::step_underflow) << method.name << ": " << report.message;
    EXPECT_NEAR(state.time, time_of_collision(1.0), 1e-6) << method.name;
    EXPECT_GE(shortest, 9.0) << method.name;
    EXPECT_LE(static_cast<double>(lockstep.work().steps), 30 * -std::log(10 * eps)) << method.name;
  }
}

}  // namespace
}  // namespace jetlag::testing::rounding_floor_test
