// SPDX-License-Identifier: MIT
// Implicit methods: what they are beyond the laws of all integrators.

#include "jetlag/integrators/implicit/implicit.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/implicit/explicit_implicit.hpp"
#include "jetlag/integrators/perturbed/random_step.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::implicit_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(RandomStep, KeepsTheAngularMomentumThatTheMidpointRuleKeeps) {
  // p = 2, h = .01, up to t = 40. Every step adds some roundings of numbers near 1: sqrt(4000) eps and less.
  const Problem scene = perturbed_planet();
  Lockstep run(std::make_unique<RandomStep>(std::make_unique<ImplicitMidpoint>(scene.system, 1e300),
                                            RandomStep::Options{.step = 0.01, .order = 2}));
  State<double> state = scene.start;
  double worst = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    const auto &x = view.state().position, &v = view.state().velocity;
    worst = std::max(worst, std::abs(x(0, 0) * v(0, 1) - x(0, 1) * v(0, 0) - 0.8));
    return true;
  };
  ASSERT_EQ(run.run(state, 40.0, options).outcome, Outcome::success);
  EXPECT_LT(worst, 1e-12) << "seed 1";
}

TEST(Implicit, StiffOscillatorsKeepTheirAmplitude) {
  // Both are the trapezoidal rule on x'' = -w^2 x: the energy stays for any h, here h w = 1000.
  const Problem scene = oscillator(1e4, 1.0, 0.0);
  EnergyMeter energy(scene.system);
  const auto error = [&](std::unique_ptr<Integrator> method) {
    State<double> state = scene.start;
    EXPECT_EQ(Lockstep(std::move(method)).run(state, 10.0, {}).outcome, Outcome::success);
    return std::abs(energy(state).total() / energy(scene.start).total() - 1);
  };
  // 100 steps. Each rounds increments of the size h w, and Newmark's of the position of the size (h w)^2 / 4.
  EXPECT_LT(error(std::make_unique<ImplicitMidpoint>(scene.system, 0.1)), 100 * 1e3 * eps);
  EXPECT_LT(error(std::make_unique<Newmark>(scene.system, 0.1)), 100 * 1e6 / 4 * eps);
}

TEST(Implicit, TurnsAnOscillatorByTheCayleyTransform) {
  // x_n = cos(n theta), tan(theta / 2) = h / 2, from x = 1 and v = 0.
  const double h = 0.5, theta = 2 * std::atan(h / 2);
  const Problem scene = oscillator();
  for (int which : {0, 1}) {
    std::unique_ptr<Integrator> method;
    if (which == 0)
      method = std::make_unique<ImplicitMidpoint>(scene.system, h);
    else
      method = std::make_unique<Newmark>(scene.system, h);
    State<double> state = scene.start;
    ASSERT_EQ(Lockstep(std::move(method)).run(state, 40 * h, {}).outcome, Outcome::success);
    EXPECT_NEAR(state.position(0, 0), std::cos(40 * theta), 40 * 8 * eps) << which;
  }
}

TEST(Implicit, FollowsDrag) {
  // v_1 = (1 - c h/2) / (1 + c h/2) v_0 for both, even where c h is large.
  Problem scene = oscillator(0.0, 0.0, 1.0);
  scene.system.add<Drag>({{0}}, {{100.0}});
  ImplicitMidpoint midpoint(scene.system, 0.25);
  Newmark newmark(scene.system, 0.25);
  for (Integrator* method : {static_cast<Integrator*>(&midpoint), static_cast<Integrator*>(&newmark)}) {
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(method->step(state, 1.0, report), 0.25) << report.message;
    EXPECT_NEAR(state.velocity(0, 0), -11.5 / 13.5, 100 * eps);
  }
}

TEST(Implicit, LeavesFixedParticlesAtRestInStiffSteps) {
  // h w = 200: the entry of the wall in the row of its neighbour is 1e4 times as large as that in its own.
  System<double> system(1, {1.0, 1.0});
  system.fix(0);
  system.add<Spring>({{0, 1}}, {{1e4, 1.0}});
  State<double> start{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Zero(2, 1)};
  start.position(1, 0) = 1.00001;
  for (const bool newmark : {false, true}) {
    std::unique_ptr<Integrator> method = std::make_unique<ImplicitMidpoint>(system, 2.0);
    if (newmark) method = std::make_unique<Newmark>(system, 2.0);
    State<double> state = start;
    ASSERT_EQ(Lockstep(std::move(method)).run(state, 100.0, {}).outcome, Outcome::success);
    EXPECT_EQ(state.position(0, 0), 0.0);
    EXPECT_EQ(state.velocity(0, 0), 0.0);
  }
}

TEST(Implicit, LargeScenesAreSolvedWithoutAMatrix) {
  // A chain of 60 particles in two dimensions (120 unknowns) at h w = 20: the energy of a quadratic potential stays.
  const int n = 60;
  System<double> system(2, std::vector<double>(n, 1.0));
  std::vector<std::array<int, 2>> pairs;
  for (int i = 1; i < n; ++i) pairs.push_back({i - 1, i});
  system.add<Spring>(pairs, {{100.0, 0.0}});  // of rest length 0: linear
  State<double> start{0.0, Coordinates<double>::Zero(n, 2), Coordinates<double>::Zero(n, 2)};
  for (int i = 0; i < n; ++i) start.position.row(i) << i, std::sin(0.3 * i);
  EnergyMeter energy(system);
  State<double> state = start;
  ASSERT_EQ(Lockstep(std::make_unique<ImplicitMidpoint>(system, 1.0)).run(state, 20.0, {}).outcome,
            Outcome::success);
  EXPECT_NEAR(energy(state).total() / energy(start).total(), 1, 1e-12);  // 20 steps, each to 2 eps
}

/// 200 unit masses between walls, every second tie as given, the others of 1 N/m.
Problem line_of_ties(double stiffness) {
  constexpr int moving = 200;
  std::vector<double> ties;
  for (int i = 0; i <= moving; ++i) ties.push_back(i % 2 == 0 ? stiffness : 1.0);
  Problem all = line(std::vector<double>(moving, 1.0), ties);
  for (int i = 1; i <= moving; ++i) all.start.velocity(i, 0) = std::sin(0.1 * i * i);
  return all;
}

TEST(Implicit, SolvesAStepWithAMatrixWhereProductsDoNot) {
  // (1 + h^2/4 K) a_1 = -K (h v_0), x_0 = 0, h = 1: solved densely here. Ties of 1e8 make the condition 1e8, and 200
  // directions that 100 iterations cannot tell apart; ties of 1 make it 2. The solution is known to that times eps.
  for (const double stiffness : {1.0, 1e8}) {
    const Problem scene = line_of_ties(stiffness);
    const int n = scene.system.particles() - 2;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i <= n; ++i) {
      const double tie = i % 2 == 0 ? stiffness : 1.0;
      if (i > 0) k(i - 1, i - 1) += tie;
      if (i < n) k(i, i) += tie;
      if (i > 0 && i < n) {
        k(i - 1, i) -= tie;
        k(i, i - 1) -= tie;
      }
    }
    const Eigen::VectorXd v = scene.start.velocity.col(0).segment(1, n);
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n) + 0.25 * k;
    const Eigen::VectorXd a = matrix.fullPivLu().solve(-(k * v)), end = v + 0.25 * a;

    State<double> state = scene.start;
    Lockstep run(std::make_unique<Newmark>(scene.system, 1.0));
    ASSERT_EQ(run.run(state, 1.0, {}).outcome, Outcome::success);
    EXPECT_LT((state.position.col(0).segment(1, n) - end).cwiseAbs().maxCoeff(), 100 * stiffness * eps)
        << stiffness;
    // With products: two a BiCGSTAB iteration, fewer than 100 of these. With a matrix, once they were in vain.
    const double evaluations = static_cast<double>(run.work().element_coefficients) / (n + 1);
    if (stiffness == 1.0)
      EXPECT_LT(evaluations, 200);
    else
      EXPECT_GT(evaluations, 200);
  }
}

TEST(Implicit, FindsTheSolutionThatIsTheMotion) {
  // Two masses, a spring of length 1 stretched to 1.2, h omega from 0.1 to 140: accelerations taken over such a step would
  // throw the masses through each other, where the equations have solutions as well. The spring stays stretched along
  // its line, where it is linear, and both rules conserve the energy of linear forces: as above, up to (h omega)^2 eps a
  // step, here 2e4 eps for 100 of them.
  for (const double stiffness : {1e2, 1e4, 1e6, 1e8}) {
    System<double> system(2, {1.0, 1.0});
    system.add<Spring>({{0, 1}}, {{stiffness, 1.0}});
    EnergyMeter energy(system);
    const State<double> start{0.0, Coordinates<double>{{0, 0}, {1.2, 0}}, Coordinates<double>::Zero(2, 2)};
    const auto error = [&](std::unique_ptr<Integrator> method) {
      State<double> state = start;
      EXPECT_EQ(Lockstep(std::move(method)).run(state, 1.0, {}).outcome, Outcome::success);
      return std::abs(energy(state).total() / energy(start).total() - 1);
    };
    const double allowed = 100 * std::max(1.0, 2 * stiffness * 1e-4) * eps;
    EXPECT_LT(error(std::make_unique<ImplicitMidpoint>(system, 0.01)), allowed) << stiffness;
    EXPECT_LT(error(std::make_unique<Newmark>(system, 0.01)), allowed) << stiffness;
    EXPECT_LT(error(std::make_unique<ExplicitImplicit>(system, 0.01, std::vector<bool>{true, true})), allowed)
        << stiffness;
  }
}

TEST(Implicit, HasNoMoreEnergyWithinAStepThanAtItsEnds) {
  // h omega = 100: a parabola through the step would have h^2 omega^2 / 16 times the energy in between.
  const Problem scene = oscillator(1e4, 1.0, 0.0);
  EnergyMeter energy(scene.system);
  for (const bool midpoint : {true, false}) {
    std::unique_ptr<Integrator> method;
    if (midpoint)
      method = std::make_unique<ImplicitMidpoint>(scene.system, 1.0);
    else
      method = std::make_unique<Newmark>(scene.system, 1.0);
    State<double> state = scene.start;
    Report report;
    ASSERT_EQ(method->step(state, 1.0, report), 1.0);
    for (const double t : {0.1, 0.5, 0.9})
      EXPECT_LE(energy(method->piece().at(t)).total(), energy(scene.start).total() * (1 + 1e-9));
  }
}

TEST(Implicit, CountsTheElementsOfItsJacobian) {
  // A linear force of one element and one unknown: where the step begins; then twice, as the second change is rounding,
  // the force and one column.
  const Problem scene = oscillator();
  ImplicitMidpoint method(scene.system, 0.25);
  State<double> state = scene.start;
  Report report;
  method.step(state, 1.0, report);
  EXPECT_EQ(method.work().element_coefficients, 1u + 2 * 2);
}

TEST(Implicit, RefusesAStepThatIsNotPositive) {
  const Problem scene = oscillator();
  EXPECT_THROW(ImplicitMidpoint(scene.system, 0.0), std::invalid_argument);
  EXPECT_THROW(Newmark(scene.system, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::implicit_test
