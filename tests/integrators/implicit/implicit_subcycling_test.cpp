// SPDX-License-Identifier: MIT
// Implicit subcycling: energy, its limit of equal steps, order, momentum.
#include "jetlag/integrators/implicit/implicit_subcycling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/implicit/implicit.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

/// wall - 100 - A - 1 - B - 1 - wall, unit masses, displacements; A is particle 1, B particle 2.
Problem wall_chain() {
  Problem chain = line({1, 1}, {100, 1, 1});
  chain.start.position(1, 0) = 0.1;
  chain.start.position(2, 0) = -0.5;
  chain.start.velocity(2, 0) = 1.0;
  return chain;
}
constexpr double explicit_limit = 0.1989974874;  // 2 / omega_max of that chain

ImplicitSubcycling::Options options(double step, int ratio, std::vector<int> coarse) {
  return {.step = step, .ratio = ratio, .coarse = std::move(coarse)};
}

TEST(ImplicitSubcycling, KeepsTheEnergyOfLinearForces) {
  // dt ten times the limit of explicit steps, the coarse step m times as long, 1e4 cycles. The energy stays to
  // rounding, at most eps (omega dt / 2)^2 = 100 eps in each of 1e4 m substeps, of either sign: a random walk of 7e-12;
  // measured 1.8e-13.
  const Problem chain = wall_chain();
  EnergyMeter energy(chain.system);
  const double begin = energy(chain.start).total();
  for (const int m : {3, 10}) {
    ImplicitSubcycling method(chain.system, options(10 * explicit_limit, m, {2}));
    State<double> state = chain.start;
    Report report;
    double worst = 0, growth = 0, last = begin;
    for (int cycle = 0; cycle < 10000; ++cycle) {
      ASSERT_GT(method.step(state, 1e9, report), 0.0) << report.message;
      const double now = energy(state).total();
      growth = std::max(growth, (now - last) / begin);
      worst = std::max(worst, std::abs(now / begin - 1));
      last = now;
    }
    EXPECT_LT(growth, 1e-12) << m;
    EXPECT_LT(worst, 1e-12) << m;
  }
}

TEST(ImplicitSubcycling, OfRatioOneIsNewmarksMethod) {
  // Whoever is called coarse; 200 steps of ten times the explicit limit, on each of which Newmark's method rounds by
  // (omega dt)^2 / 4 = 100 eps.
  const Problem chain = wall_chain();
  for (const std::vector<int>& coarse : {std::vector<int>{}, {1}, {2}, {1, 2}}) {
    ImplicitSubcycling method(chain.system, options(10 * explicit_limit, 1, coarse));
    Newmark newmark(chain.system, 10 * explicit_limit);
    State<double> one = chain.start, other = chain.start;
    Report report;
    for (int step = 0; step < 200; ++step) {
      method.step(one, 1e9, report);
      newmark.step(other, 1e9, report);
      ASSERT_LT((one.position - other.position).norm(), 1e-12) << step;
      ASSERT_LT((one.velocity - other.velocity).norm(), 1e-12) << step;
    }
  }
}

TEST(ImplicitSubcycling, HasOrderTwoAtAnyRatio) {
  // A cube of springs with drag on some particles, half of them coarse, against degree 20 at t = 2: nonlinear, with a
  // large interface. Cycles of 0.05 and 0.025 s; the next term of a symmetric method is of order 4.
  Problem cube = spring_cube(2);
  cube.system.add<Drag>({{1}, {4}}, {{0.3}});
  State<double> exact = cube.start;
  Lockstep taylor_20(taylor(cube.system, 20, std::make_unique<FixedStep>(0.05)));
  ASSERT_EQ(taylor_20.run(exact, 2.0, {}).outcome, Outcome::success);
  for (const int m : {1, 2, 5, 10}) {
    std::vector<double> errors;
    for (const double cycle : {0.05, 0.025}) {
      Lockstep run(std::make_unique<ImplicitSubcycling>(cube.system, options(cycle / m, m, {1, 3, 5, 7})));
      State<double> state = cube.start;
      ASSERT_EQ(run.run(state, 2.0, {}).outcome, Outcome::success);
      errors.push_back((state.position - exact.position).norm() + (state.velocity - exact.velocity).norm());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1) << m;
  }
}

TEST(ImplicitSubcycling, KeepsMomentumToRounding) {
  // What a fine element does to a coarse particle over a cycle is the sum of what it does to the fine one: 40 cycles of
  // 5 substeps, each solved to some eps of velocities below 1 in masses below 2.
  const Problem cube = spring_cube(3);
  Lockstep run(std::make_unique<ImplicitSubcycling>(cube.system, options(0.01, 5, {0, 2, 4, 6})));
  State<double> state = cube.start;
  ASSERT_EQ(run.run(state, 2.0, {}).outcome, Outcome::success);
  EXPECT_LT((momentum(cube.system, state) - momentum(cube.system, cube.start)).norm(), 1e-13);
}

TEST(ImplicitSubcycling, SolvesLargeScenes) {
  // A chain of 200 moving particles, the outer half coarse, so that its matrices are sparse: the energy stays.
  const int n = 200;
  System<double> system(1, std::vector<double>(n + 1, 1.0));
  system.fix(0);
  std::vector<std::array<int, 2>> pairs;
  std::vector<int> coarse;
  for (int i = 1; i <= n; ++i) pairs.push_back({i - 1, i});
  for (int i = 1; i <= n; ++i)
    if (i > 100) coarse.push_back(i);
  system.add<LinearSpring>(pairs, {{100.0}});
  State<double> start{0.0, Coordinates<double>::Zero(n + 1, 1), Coordinates<double>::Zero(n + 1, 1)};
  for (int i = 1; i <= n; ++i) start.position(i, 0) = std::sin(0.3 * i);
  EnergyMeter energy(system);
  State<double> state = start;
  ASSERT_EQ(Lockstep(std::make_unique<ImplicitSubcycling>(system, options(1.0, 3, coarse)))
                .run(state, 30.0, {})
                .outcome,
            Outcome::success);
  EXPECT_NEAR(energy(state).total() / energy(start).total(), 1.0, 1e-12);  // 30 substeps, each to 100 eps
  EXPECT_GT((state.position - start.position).norm(), 1.0);
}

TEST(ImplicitSubcycling, KeepsTheEnergyOfAStiffSpring) {
  // Two masses in the plane at rest, 1.2 apart on a slanted line, a spring of rest length 1 and 1e6 N/m: omega dt = 14.
  // On their line, and as long as they do not meet, its tension is linear in its length, though the force is not in the
  // positions: the energy stays to rounding. Positions are below 5 (the centre of mass is no constant), a rounding of
  // them is 50 eps of the energy, carried on by (omega dt / 2)^2 = 50: in 100 steps 6e-11. Measured 2e-14.
  System<double> system(2, {1.0, 1.0});
  system.add<Spring>({{0, 1}}, {{1e6, 1.0}});
  State<double> start{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
  start.position.row(1) << 1.2 * std::cos(0.7), 1.2 * std::sin(0.7);
  EnergyMeter energy(system);
  const double begin = energy(start).total();
  for (const int m : {1, 2}) {
    double worst = 0, way = 0;
    RunOptions run;
    run.observer.after_step = [&](const StepView& view) {
      worst = std::max(worst, std::abs(energy(view.state()).total() / begin - 1));
      way = std::max(way, (view.state().position - start.position).norm());
      return true;
    };
    State<double> state = start;
    Lockstep lockstep(std::make_unique<ImplicitSubcycling>(system, options(0.01, m, {1})));
    const Report report = lockstep.run(state, 1.0, run);
    ASSERT_EQ(report.outcome, Outcome::success) << report.message;
    EXPECT_LT(worst, 6e-11) << m;
    EXPECT_GT(way, 0.1) << m;
  }
}

/// wall - 1e6 - A - 1 - B, unit masses, displacements; B is particle 2.
Problem stiff_chain() {
  Problem chain = line({1, 1}, {1e6, 1});
  chain.start.position(1, 0) = 0.1;
  chain.start.position(2, 0) = -0.5;
  return chain;
}

TEST(ImplicitSubcycling, NoEnergyIsInventedWithinACycle) {
  // omega h = 100. The energy is convex, and on a line between two states of one energy never above it. At the ends
  // it stays to eps (omega dt / 2)^2 = 25 eps in each of 100 substeps.
  const Problem chain = stiff_chain();
  EnergyMeter energy(chain.system);
  const double begin = energy(chain.start).total();
  ImplicitSubcycling method(chain.system, options(0.01, 10, {2}));
  State<double> state = chain.start;
  Report report;
  for (int cycle = 0; cycle < 10; ++cycle) {
    const double h = method.step(state, 1.0, report);
    ASSERT_GT(h, 0.0) << report.message;
    const Piece piece = method.piece();
    for (int frame = 0; frame <= 100; ++frame)
      EXPECT_LT(energy(piece.at(piece.begin + frame / 100.0 * h)).total() / begin, 1 + 1e-12)
          << cycle << " " << frame;
    state.time += h;
  }
}

TEST(ImplicitSubcycling, WithinACycleTheErrorIsThatOfALine) {
  // x = cos t: a line over h is wrong by at most h^2 / 8 = 1.25e-3, positions and velocities, and its ends at t = 1 by
  // (h / 2)^2 t / 12 = 2.1e-4, the phase of the trapezoidal rule in steps of h / 2.
  const Problem scene = oscillator();
  ImplicitSubcycling method(scene.system, options(0.05, 2, {}));
  State<double> state = scene.start;
  Report report;
  double worst = 0;
  for (int cycle = 0; cycle < 10; ++cycle) {
    const double h = method.step(state, 1.0, report);
    ASSERT_GT(h, 0.0) << report.message;
    const Piece piece = method.piece();
    for (int frame = 0; frame <= 20; ++frame) {
      const State<double> at = piece.at(piece.begin + frame / 20.0 * h);
      worst = std::max({worst, std::abs(at.position(0, 0) - std::cos(at.time)),
                        std::abs(at.velocity(0, 0) + std::sin(at.time))});
    }
    state.time += h;
  }
  EXPECT_LT(worst, 1.25e-3 + 2.1e-4);
}

TEST(ImplicitSubcycling, ACycleThatIsCroppedTakesFewerSubsteps) {
  // Of at most dt, all alike. Two passes of Newton's method each evaluate every substep once, beside what is evaluated
  // at the ends of a cycle: the count is linear in the substeps.
  const Problem chain = wall_chain();
  const auto coefficients = [&](double step, int ratio, double limit) {
    ImplicitSubcycling method(chain.system, options(step, ratio, {2}));
    State<double> state = chain.start;
    Report report;
    EXPECT_EQ(method.step(state, limit, report), std::min(limit, ratio * step)) << report.message;
    return method.work().element_coefficients;
  };
  EXPECT_EQ(coefficients(0.001, 1000, 0.001), coefficients(0.001, 1, 0.001));
  EXPECT_EQ(coefficients(0.001, 1000, 0.0003), coefficients(0.001, 1, 0.001));
  EXPECT_EQ(coefficients(0.1, 1000, 0.3 * (1 + 1e-12)), coefficients(0.1, 3, 1.0));  // some roundings: not 4
  EXPECT_EQ(coefficients(0.001, 1000, 0.0031), coefficients(0.001, 4, 1.0));
  EXPECT_GT(coefficients(0.001, 4, 1.0), coefficients(0.001, 3, 1.0));
}

TEST(ImplicitSubcycling, TheShortestStepHasAPiece) {
  // Of 1e-300 s, in which nothing moves by more than a rounding of it.
  const Problem chain = wall_chain();
  for (const double h : {1e-300, 1e-310, std::numeric_limits<double>::denorm_min()}) {
    ImplicitSubcycling method(chain.system, options(0.01, 10, {2}));
    State<double> state = chain.start;
    Report report;
    ASSERT_EQ(method.step(state, h, report), h) << report.message;
    const Piece piece = method.piece();
    for (const double t : {0.0, h}) {
      EXPECT_LT((piece.at(t).position - chain.start.position).norm(), 1e-15) << h;
      EXPECT_LT((piece.at(t).velocity - chain.start.velocity).norm(), 1e-15) << h;
    }
  }
}

TEST(ImplicitSubcycling, RefusesCyclesThatDoNotFitIntoMemory) {
  // Per substep 8 (f (1 + i) + 2 n) = 8 (1 * 2 + 2 * 4) = 80 bytes: 2 GiB are 2.68e7 substeps.
  const Problem chain = wall_chain();
  EXPECT_NO_THROW(ImplicitSubcycling(chain.system, options(1e-9, 26'000'000, {2})));
  try {
    ImplicitSubcycling(chain.system, options(1e-9, 27'000'000, {2}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(
        std::string(error.what()).find("27000000 substeps with 1 fine components and 1 of the interface"),
        std::string::npos)
        << error.what();
  }
}

TEST(ImplicitSubcycling, RefusesWhatItCannotDo) {
  const Problem chain = wall_chain();
  for (const auto& bad : {options(0.0, 1, {}), options(0.1, 0, {}), options(0.1, 2, {4}),
                          options(0.1, 2, {-1}), options(0.1, 2, {1, 1})})
    EXPECT_THROW(ImplicitSubcycling(chain.system, bad), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing
