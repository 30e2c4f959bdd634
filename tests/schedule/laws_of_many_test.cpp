// SPDX-License-Identifier: MIT
// Elements of three and four particles in every method that knows elements: all move alike, and keep what they should.
#include "support/laws/laws_of_many.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/ensembles/ensemble.hpp"
#include "jetlag/ensembles/random_ensemble.hpp"
#include "jetlag/integrators/implicit/implicit.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/avi.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/qss.hpp"
#include "jetlag/schedule/subcycling.hpp"
#include "support/laws/jelly.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::laws_of_many_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

State<double> run(const Problem& scene, Schedule& schedule, double until) {
  State<double> state = scene.start;
  const Report report = schedule.run(state, until, {});
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  return state;
}
State<double> run(const Problem& scene, std::unique_ptr<Integrator> method, double until) {
  Lockstep lockstep(std::move(method));
  return run(scene, lockstep, until);
}
State<double> truth(const Problem& scene, double until) {
  return run(scene, taylor(scene.system, 16, std::make_unique<JorbaZou>(0.1)), until);
}

double distance(const State<double>& a, const State<double>& b) {
  return std::max((a.position - b.position).cwiseAbs().maxCoeff(),
                  (a.velocity - b.velocity).cwiseAbs().maxCoeff());
}
/// How far momentum and angular momentum have gone.
double lost_momentum(const Problem& scene, const State<double>& end) {
  return std::max((momentum(scene.system, end) - momentum(scene.system, scene.start)).cwiseAbs().maxCoeff(),
                  (angular_momentum(scene.system, end) - angular_momentum(scene.system, scene.start))
                      .cwiseAbs()
                      .maxCoeff());
}
double lost_energy(const Problem& scene, const State<double>& end) {
  EnergyMeter energy(scene.system);
  return std::abs(energy(end).total() / energy(scene.start).total() - 1);
}

TEST(LawsOfMany, KeepEnergyAndMomentumInLockstep) {
  // Some 100 steps, each of which rounds the numbers near 1 of 8 particles.
  const Problem scene = jelly();
  const State<double> end = truth(scene, 5.0);
  EXPECT_LT(lost_energy(scene, end), 100 * 8 * eps);
  EXPECT_LT(lost_momentum(scene, end), 100 * 8 * eps);
  EXPECT_GT(distance(end, scene.start), 0.5);  // the test is not idle
}

TEST(LawsOfMany, MoveAlikeOnClocksOfTheirOwn) {
  // Each of some 100 steps of a particle is wrong by the tolerance at most, and so are its neighbours' series.
  const Problem scene = jelly();
  const State<double> end = truth(scene, 5.0);
  for (const double tolerance : {1e-9, 1e-11}) {
    BlockSteps::Options of_block;
    of_block.tolerance = tolerance;
    BlockSteps block(scene.system, 10, of_block);
    EXPECT_LT(distance(run(scene, block, 5.0), end), 100 * tolerance);
    Asynchronous::Options of_each;
    of_each.tolerance = tolerance;
    Asynchronous each(scene.system, 10, of_each);
    EXPECT_LT(distance(run(scene, each, 5.0), end), 100 * tolerance);
  }
}

TEST(LawsOfMany, MoveAlikeInLanes) {
  // Of 19 trajectories the first starts as the scene does. Steps are those of Jorba and Zou, to rounding.
  const Problem scene = jelly();
  std::vector<State<double>> starts(19, scene.start);
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i].velocity *= 1 + 0.01 * static_cast<double>(i);
  Ensemble ensemble(scene.system, 16, starts);
  ensemble.advance_to(5.0);
  for (const std::size_t i : {0u, 18u}) {
    const Problem alone{scene.system, starts[i]};
    ASSERT_EQ(ensemble.outcome(i), Outcome::success);
    EXPECT_LT(distance(ensemble.state(i), truth(alone, 5.0)), 1e-12);
  }
  RandomEnsemble::Options in_lanes, one_by_one;
  in_lanes.layout = RandomEnsemble::Layout::in_lanes;
  one_by_one.layout = RandomEnsemble::Layout::one_by_one;
  const SeriesMethod method{geometric(3, 8, 0.5), {.seed = 5}, std::make_shared<FixedStep>(0.01)};
  RandomEnsemble lanes(scene.system, method, {scene.start, scene.start}, in_lanes),
      alone(scene.system, method, {scene.start, scene.start}, one_by_one);
  lanes.advance_to(1.0);
  alone.advance_to(1.0);
  for (const std::size_t i : {0u, 1u}) EXPECT_LT(distance(lanes.state(i), alone.state(i)), 1e-12);
}

TEST(LawsOfMany, KeepMomentumAtRandomDegrees) {
  // One draw for all weights the forces of all alike. 500 steps of 0.01, each of which rounds 8 particles' numbers near 1.
  const Problem scene = jelly();
  RandomTaylor::Options options;
  options.seed = 3;
  const State<double> end = run(scene,
                                std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5),
                                                               std::make_unique<FixedStep>(0.01), options),
                                5.0);
  EXPECT_NEAR((momentum(scene.system, end) - momentum(scene.system, scene.start)).norm(), 0, 500 * 8 * eps);
  EXPECT_GT(distance(end, truth(scene, 5.0)), 1e-9);  // degrees are random
}

TEST(LawsOfMany, KeepMomentumUnderImpulses) {
  // Each element by itself: order 2, at 1/20 of the limit 2/omega, omega < 12 of one spring: the energy error is some
  // (omega h)^2 / 8 of the swinging part.
  const Problem scene = jelly();
  const State<double> end = truth(scene, 5.0);
  double coarse = 0;
  for (const double h : {0.01, 0.005}) {
    ElementSteps steps = equal_steps(scene.system, h);
    for (double& step : steps[2]) step = 2 * h;  // the angles
    Avi avi(scene.system, steps);
    const State<double> state = run(scene, avi, 5.0);
    EXPECT_LT(lost_momentum(scene, state), 500 * 8 * 8 * eps);
    const double error = distance(state, end);
    if (coarse > 0) {
      EXPECT_NEAR(std::log2(coarse / error), 2.0, 0.1);
    }
    coarse = error;
  }
  EXPECT_LT(coarse, 1e-2);
  Subcycling subcycling(scene.system, ParticleSteps(8, 0.005));
  Avi as_one(scene.system, equal_steps(scene.system, 0.005));
  EXPECT_LT(distance(run(scene, subcycling, 5.0), run(scene, as_one, 5.0)), 1e-11);  // both leapfrog
}

TEST(LawsOfMany, KeepMomentumInImplicitSteps) {
  // Newton's method ends where the equations hold to rounding. Order 2.
  const Problem scene = jelly();
  const State<double> end = truth(scene, 2.0);
  double coarse = 0;
  for (const double h : {0.01, 0.005}) {
    const State<double> state = run(scene, std::make_unique<Newmark>(scene.system, h), 2.0);
    EXPECT_NEAR((momentum(scene.system, state) - momentum(scene.system, scene.start)).norm(), 0, 1e-12);
    const double error = distance(state, end);
    if (coarse > 0) {
      EXPECT_NEAR(std::log2(coarse / error), 2.0, 0.1);
    }
    coarse = error;
  }
}

TEST(LawsOfMany, HoldStillWhereTheyAreFixed) {
  Problem scene = jelly();
  for (const int corner : {0, 5}) {
    scene.system.fix(corner);
    scene.start.velocity.row(corner).setZero();
  }
  const State<double> end = truth(scene, 3.0);
  EXPECT_LT(lost_energy(scene, end), 100 * 8 * eps);
  BlockSteps::Options options;
  options.tolerance = 1e-11;
  BlockSteps block(scene.system, 10, options);
  const State<double> of_block = run(scene, block, 3.0);
  EXPECT_LT(distance(of_block, end), 1e-9);
  Ensemble ensemble(scene.system, 16, {scene.start});
  ensemble.advance_to(3.0);
  EXPECT_LT(distance(ensemble.state(0), end), 1e-12);
  for (const int corner : {0, 5})
    for (const State<double>& state : {end, of_block, ensemble.state(0)})
      EXPECT_EQ(state.position.row(corner), scene.start.position.row(corner));
}

TEST(LawsOfMany, FollowCompensatedSums) {
  // 10^5 steps of 5e-5: plain sums lose some 1e5^(1/2) roundings, compensated ones hardly any. The separations of all four
  // participants must know of the rests.
  const Problem scene = jelly();
  const State<double> end = truth(scene, 0.5);
  const auto error = [&](bool compensated) {
    RandomTaylor::Options options;
    options.compensated = compensated;
    return distance(run(scene,
                        std::make_unique<RandomTaylor>(scene.system, fixed_degree(6),
                                                       std::make_unique<FixedStep>(5e-5), options),
                        0.5),
                    end);
  };
  EXPECT_LT(error(true), 8 * eps);
  EXPECT_GT(error(false), 8 * eps);
}

TEST(LawsOfMany, AreRefusedWhereForcesArePairs) {
  const Problem scene = jelly();
  try {
    Qss(scene.system, {.order = 2, .quantum = 1e-3, .velocity_quantum = 1e-3});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "qss knows forces on one particle and between two; tetrahedron acts on 4: leave it out or "
                 "take another integrator");
  }
  System<double> anchored(1, {1.0, 1.0});
  anchored.add<Anchors>({{0, 1}}, {{1.0}});
  EXPECT_THROW(Qss(anchored, {.order = 2, .quantum = 1e-3, .velocity_quantum = 1e-3}), std::invalid_argument);
}

TEST(ExternalLaws,
     GiveEachParticipantItsOwnForce) {  // F_0 = -k x_0, F_1 = -2 k x_1: cosines of frequencies 2 and sqrt 8
  Problem scene{System<double>(1, {1.0, 1.0}),
                {0.0, Coordinates<double>::Constant(2, 1, 1.0), Coordinates<double>::Zero(2, 1)}};
  scene.system.add<Anchors>({{0, 1}}, {{4.0}});
  const auto expect_cosines = [](const State<double>& state, double tolerance) {
    EXPECT_NEAR(state.position(0, 0), std::cos(2 * 3.0), tolerance);
    EXPECT_NEAR(state.position(1, 0), std::cos(std::sqrt(8.0) * 3.0), tolerance);
  };
  expect_cosines(truth(scene, 3.0), 100 * eps);
  BlockSteps::Options options;
  options.tolerance = 1e-11;
  BlockSteps block(scene.system, 10, options);
  expect_cosines(run(scene, block, 3.0), 1e-9);
  Ensemble ensemble(scene.system, 16, {scene.start});
  ensemble.advance_to(3.0);
  expect_cosines(ensemble.state(0), 1e-12);
  Avi avi(scene.system, courant_steps(scene.system, 0.01));  // omega h = 0.02: phases lag by (omega h)^2 / 24
  expect_cosines(run(scene, avi, 3.0), 1e-3);
}

}  // namespace
}  // namespace jetlag::testing::laws_of_many_test
