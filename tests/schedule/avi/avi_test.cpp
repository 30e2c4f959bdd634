// SPDX-License-Identifier: MIT
// Asynchronous variational integrators: what they conserve, what they cost, and when they show themselves.
#include "jetlag/schedule/avi.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"
#include "schedule/avi/avi_for_tests.hpp"
#include "schedule/without_a_trace.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The relative energy errors at `count` equal times of a run.
std::vector<double> energy_errors(const Problem& scene, Schedule& schedule, double until, int count) {
  EnergyMeter energy(scene.system);
  const double begin = energy(scene.start).total();
  std::vector<double> errors;
  RunOptions options;
  for (int i = 1; i <= count; ++i) options.observer.frame_times.push_back(until * i / count);
  options.observer.at_frame = [&](const State<double>& state) {
    errors.push_back(std::abs(energy(state).total() - begin) / begin);
  };
  State<double> state = scene.start;
  EXPECT_EQ(schedule.run(state, until, options).outcome, Outcome::success);
  EXPECT_EQ(errors.size(), static_cast<std::size_t>(count));
  return errors;
}
double largest(const std::vector<double>& errors, double from = 0, double to = 1) {
  const auto n = static_cast<double>(errors.size());
  return *std::max_element(errors.begin() + static_cast<int>(from * n),
                           errors.begin() + static_cast<int>(to * n));
}

// ---- conservation ------------------------------------------------------------------------------------------

double common_period(double f) { return common_period_of_ten_masses(f); }

TEST(Avi, HasTheEnergyErrorOfTheReferenceWithoutDrift) {
  // At common times up to 2000. Reference: a loop over these two clocks in plain arrays, written without the library; the
  // motion is regular, so that roundings do not grow to 1e-4 of an error. Up to 1e5: `jetlag study avi_drift`.
  const Problem chain = ten_masses();
  EnergyMeter energy(chain.system);
  EXPECT_NEAR(energy(chain.start).total(), 0.040064470729897, 1e-15);
  double coarse = 0;
  for (const auto& [f, reference] : {std::pair(0.1, 0.01887), std::pair(0.05, 0.004283)}) {
    Avi avi(chain.system, courant_steps(chain.system, f));
    const int count = static_cast<int>(2e3 / common_period(f));
    const auto errors = energy_errors(chain, avi, count * common_period(f), count);
    const double worst = largest(errors);
    EXPECT_NEAR(worst, reference, 1e-3 * reference);
    EXPECT_NEAR(largest(errors, 0.9, 1) / largest(errors, 0, 0.1), 1.0, 0.1);
    if (coarse > 0) {
      EXPECT_NEAR(coarse / worst, 4.0, 0.5);
    }  // order 2: f^2, and a share of f^4
    coarse = worst;
  }
}

TEST(Avi, KeepsMomentumToRounding) {
  // Impulses on two particles are opposite to the last bit, masses are 1: what remains are roundings of velocities below
  // 0.5, of 5.6e-17 each, in 2 x 315000 updates of a random walk: 4.4e-14.
  const Problem chain = ten_masses();
  Avi avi(chain.system, courant_steps(chain.system, 0.1));
  State<double> state = chain.start;
  ASSERT_EQ(avi.run(state, 1e3, {}).outcome, Outcome::success);
  EXPECT_NEAR(momentum(chain.system, state)(0), 0.5, 1e-13);
}

TEST(Avi, KeepsAngularMomentumOfSpringsInSpace) {
  const Problem cube = spring_cube(3);
  Avi avi(cube.system, courant_steps(cube.system, 0.2));
  State<double> state = cube.start;
  ASSERT_EQ(avi.run(state, 100.0, {}).outcome, Outcome::success);
  // Each impulse is along the line between two particles that are where they are, so that x ^ v of the lines stays; what
  // is seen between impulses differs by what is yet to come: of second order in the step.
  const Eigen::VectorXd before = angular_momentum(cube.system, cube.start),
                        after = angular_momentum(cube.system, state);
  EXPECT_LT((after - before).norm(), 0.02 * before.norm());
}

// ---- order -------------------------------------------------------------------------------------------------

TEST(Avi, IsLeapfrogWhereAllStepsAreEqual) {
  // The same impulses; leapfrog sums a parabola, this one two halves: 1000 steps of roundings of 1e-16 that grow by
  // t omega = 70 at most.
  const Problem cube = spring_cube(1);
  State<double> one = cube.start, other = cube.start;
  Avi avi(cube.system, equal_steps(cube.system, 0.01));
  Lockstep leapfrog(std::make_unique<Leapfrog>(cube.system, 0.01));
  ASSERT_EQ(avi.run(one, 10.0, {}).outcome, Outcome::success);
  ASSERT_EQ(leapfrog.run(other, 10.0, {}).outcome, Outcome::success);
  EXPECT_LT((one.position - other.position).norm(), 1e-11);
  EXPECT_LT((one.velocity - other.velocity).norm(), 1e-11);
  EXPECT_EQ(avi.work().steps, 1000u);
  EXPECT_EQ(avi.work().element_coefficients, 1001u * 28u);
}

TEST(Avi, HasOrderTwo) {
  // Errors against degree 20; halving all steps divides them by 4, and by no less than 3.4 of the next order.
  const Problem cube = spring_cube(2);
  State<double> exact = cube.start;
  Lockstep taylor_20(taylor(cube.system, 20, std::make_unique<FixedStep>(0.05)));
  ASSERT_EQ(taylor_20.run(exact, 3.0, {}).outcome, Outcome::success);
  std::vector<double> errors;
  for (const double f : {0.04, 0.02, 0.01}) {
    Avi avi(cube.system, courant_steps(cube.system, f));
    State<double> state = cube.start;
    ASSERT_EQ(avi.run(state, 3.0, {}).outcome, Outcome::success);
    errors.push_back((state.position - exact.position).norm());
  }
  EXPECT_THAT(std::log2(errors[0] / errors[2]) / 2, ::testing::DoubleNear(2.0, 0.25));
}

TEST(Avi, FollowsAParabolaAtItsClocks) {
  // Free fall: impulses at the ends of steps and halves at both ends are exact for a constant force.
  const Problem scene = free_fall();
  Avi avi(scene.system, equal_steps(scene.system, 0.125));
  State<double> state = scene.start;
  ASSERT_EQ(avi.run(state, 2.0, {}).outcome, Outcome::success);
  EXPECT_NEAR(state.position(0, 2), 3.0 + 4.0 * 2 - 9.75 * 2, 1e-13);
  EXPECT_NEAR(state.velocity(0, 2), 4.0 - 9.75 * 2, 1e-13);
}

// ---- cost --------------------------------------------------------------------------------------------------

/// Springs in a row of `pairs`, every tenth one stiffer by `ratio`.
Problem mixed_chain(double ratio) {
  constexpr int n = 202;
  System<double> system(1, std::vector<double>(n, 1.0));
  Problem scene{std::move(system), {0.0, Coordinates<double>(n, 1), Coordinates<double>::Zero(n, 1)}};
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 1>> stiffness;
  for (int i = 0; i < n; ++i) {
    scene.start.position(i, 0) = i;
    scene.start.velocity(i, 0) = 0.1 * std::sin(1.0 + i * i);
    if (i + 1 == n) continue;
    pairs.push_back({i, i + 1});
    stiffness.push_back({i % 10 == 5 ? ratio : 1.0});
  }
  scene.system.add<HardeningSpring>(pairs, stiffness);
  return scene;
}

TEST(Avi, EvaluatesTheSoftElementsLessOften) {
  // A tenth of the elements r^2 times stiffer than the rest: 0.1 + 0.9/r of the force evaluations of leapfrog at the steps
  // of the stiff ones, but for 202 particles and the first evaluations. At equal stability that is 0.385 for ten times
  // stiffer springs and 0.19 for a hundred times.
  //
  // At equal energy error less is gained, for the soft elements then have steps as coarse as the stiff ones: the root
  // mean square here is 0.0103 for both ratios, that of leapfrog at fractions of 0.33 and 0.41 of its limit.
  for (const double r : {std::sqrt(10.0), 10.0}) {
    const Problem chain = mixed_chain(r * r);
    const ElementSteps steps = courant_steps(chain.system, 0.1);
    Avi avi(chain.system, steps);
    Lockstep leapfrog(std::make_unique<Leapfrog>(chain.system, steps[0][5]));
    const double worst = largest(energy_errors(chain, avi, 100.0, 777));
    energy_errors(chain, leapfrog, 100.0, 1);
    EXPECT_NEAR(static_cast<double>(avi.work().element_coefficients) /
                    static_cast<double>(leapfrog.work().element_coefficients),
                0.1 + 0.9 / r, 0.01);
    EXPECT_LT(worst, 0.05);
  }
}

// ---- when it shows itself ----------------------------------------------------------------------------------

TEST(Avi, EndsAndIsSeenAtAnyTimeWithoutATrace) {
  expect_ends_and_frames_leave_no_trace(
      [](const System<double>& system) { return Avi(system, courant_steps(system, 0.2)); });
}

TEST(Avi, LeavesATrajectoryThatMeetsItself) {
  const Problem cube = spring_cube(5);
  Avi avi(cube.system, courant_steps(cube.system, 0.2));
  State<double> state = cube.start;
  Trajectory motion;
  ASSERT_EQ(record(avi, state, 2.0, motion).outcome, Outcome::success);
  EXPECT_EQ(motion.begin(), 0.0);
  EXPECT_EQ(motion.end(), 2.0);
  EXPECT_NEAR((motion.at(2.0).position - state.position).norm(), 0, 1e-14);
  EXPECT_NEAR((motion.at(0.0).velocity - cube.start.velocity).norm(), 0, 1e-14);
}

TEST(Avi, TellsTheUpdatesOfEachParticle) {
  const Problem chain = wall_chain();
  Avi avi(chain.system, wall_chain_steps(0.125, 2));
  std::vector<double> known_until(4, 0.0);
  RunOptions options;
  options.observer.on_update = [&](const Update& update) {
    EXPECT_EQ(update.begin, known_until[update.particle]);
    EXPECT_EQ(update.step, update.particle == 1 ? 0.125 : 0.25);
    known_until[update.particle] += update.step;
  };
  State<double> state = chain.start;
  ASSERT_EQ(avi.run(state, 1.0, options).outcome, Outcome::success);
  EXPECT_THAT(known_until, ElementsAre(0.0, 1.0, 1.0, 0.0));  // the walls are fixed
  EXPECT_EQ(avi.work().steps, 8u);
  EXPECT_EQ(avi.work().updates, 8u + 2 * 4u);  // particle 1 by the stiff clock, both by the soft one
}

// ---- what it refuses ---------------------------------------------------------------------------------------

TEST(Avi, RefusesForcesWithoutAPotentialInThePositions) {
  System<double> system(1, {1.0});
  system.add<Drag>({{0}}, {{0.2}});
  EXPECT_THAT(
      [&] { Avi(system, equal_steps(system, 0.1)); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("drag"), HasSubstr("depends on velocities"))));
  System<double> shaken(1, {1.0});
  shaken.add<Shaker>({{0}}, {{1.0}});
  EXPECT_THAT([&] { Avi(shaken, equal_steps(shaken, 0.1)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("depends on time")));
  System<double> pushed(1, {1.0});
  pushed.add<CubicPush>({{0}}, {{}});
  EXPECT_THAT([&] { Avi(pushed, equal_steps(pushed, 0.1)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("not the gradient")));
}

TEST(Avi, RefusesStepsThatAreNone) {
  const Problem chain = wall_chain();
  for (const ElementSteps& steps : {ElementSteps{}, ElementSteps{{0.1}}, ElementSteps{{0.1, 0.0, 0.1}}})
    EXPECT_THROW(Avi(chain.system, steps), std::invalid_argument);
  EXPECT_THROW(courant_steps(chain.system, 1.5), std::invalid_argument);
  EXPECT_THROW(courant_steps(planet(0.5).system, 0.1), std::invalid_argument);  // gravity has no stiffness
}

TEST(Avi, GivesAConstantForceTheShortestStepOfItsParticle) {
  Problem chain = wall_chain();
  chain.system.add<UniformField>({{1}, {2}}, {{-9.8, 0.0, 0.0}});
  const ElementSteps steps = courant_steps(chain.system, 0.1);
  EXPECT_THAT(steps[1], ElementsAre(steps[0][0], steps[0][1]));
}

TEST(Avi, ReportsAMotionThatBlowsUpAndKeepsItsLastGoodState) {
  const Problem chain = wall_chain();
  Avi avi(chain.system, equal_steps(chain.system, 1.0));  // five times the limit
  State<double> state = chain.start;
  state.velocity(1, 0) = 0.1;
  const Report report = avi.run(state, 1e4, {});
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_THAT(report.message, AllOf(HasSubstr("particle"), HasSubstr("t = "), HasSubstr("shorter steps")));
  EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
  EXPECT_GT(state.time, 50.0);
}

TEST(Avi, StopsAtTheLargestNumberOfStepsAndWhenAsked) {
  const Problem chain = wall_chain();
  RunOptions options;
  options.max_steps = 6;
  State<double> state = chain.start;
  EXPECT_EQ(Avi(chain.system, equal_steps(chain.system, 0.125)).run(state, 10.0, options).outcome,
            Outcome::step_limit);
  EXPECT_EQ(state.time, 0.875);  // where the seventh impulse would come
  options = {};
  options.observer.after_step = [](const StepView& view) { return view.end() < 0.5; };
  state = chain.start;
  EXPECT_EQ(Avi(chain.system, equal_steps(chain.system, 0.125)).run(state, 10.0, options).outcome,
            Outcome::interrupted);
  EXPECT_EQ(state.time, 0.5);
}

}  // namespace
}  // namespace jetlag::testing
