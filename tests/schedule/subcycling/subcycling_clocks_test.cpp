// SPDX-License-Identifier: MIT
// Clocks of subcycling: who is seen when, frames and stops, and what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jetlag/forces/forces.hpp"
#include "jetlag/schedule/record.hpp"
#include "schedule/subcycling/subcycling_for_tests.hpp"
#include "schedule/without_a_trace.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// ---- who is seen when --------------------------------------------------------------------------------------

TEST(SubcyclingClocks, SeesNobodyOutsideTheStepOfItsOwn) {
  // Whenever a particle is updated, at t, every other one's step has begun by t and does not end before t.
  const Problem cube = spring_cube(3);
  const double h = 0.01;
  const ParticleSteps steps{h, h * std::numbers::phi,  h * std::numbers::e, 3 * h, h * 7.0 / 3, 2.5 * h,
                            h, h * std::numbers::sqrt2};
  std::vector<double> begin(8, 0.0);
  RunOptions options;
  int together = 0;
  double last = 0;
  options.observer.on_update = [&](const Update& update) {
    const double t = update.begin + update.step;
    EXPECT_EQ(update.begin, begin[update.particle]);
    EXPECT_NEAR(update.step, steps[update.particle], 1e-14);
    for (int i = 0; i < 8; ++i) {
      EXPECT_LE(begin[i], t + 1e-14);
      EXPECT_LE(t, begin[i] + steps[i] + 1e-14);
    }
    begin[update.particle] = t;
    together += std::abs(t - last) < 1e-14;
    last = t;
  };
  State<double> state = cube.start;
  ASSERT_EQ(Subcycling(cube.system, steps).run(state, 2.1, options).outcome, Outcome::success);
  // Of equal steps: 0 and 6, 210 times. Of whole ratios: 3 h with h 70 times, 7/3 h every 7 h with them (30) and 2.5 h
  // every 5 h (42).
  EXPECT_EQ(together, 210 + 70 + 30 + 42);
}

TEST(SubcyclingClocks, RingTogetherAtWholeRatiosHoweverLong) {
  // Steps of h = 0.1 and 7 h, but for four roundings, as of square roots and quotients: 4.4e-16 s a cycle, after 400000
  // cycles more than a billionth of a step. The seventh ring of h is still one with the other.
  System<double> system(1, {1.0, 1.0});
  State<double> state{0.0, Coordinates<double>::Zero(2, 1), Coordinates<double>::Zero(2, 1)};
  const double h = 0.1;
  double slow = 7 * h;
  for (int i = 0; i < 4; ++i) slow = std::nextafter(slow, 1.0);
  Subcycling method(system, {h, slow});
  ASSERT_EQ(method.run(state, 7 * h * 400'000, {}).outcome, Outcome::success);
  EXPECT_EQ(method.work().updates, 400'000u * (7 + 1));
  EXPECT_EQ(method.work().steps, 400'000u * 7);
}

TEST(SubcyclingClocks, EndsAndIsSeenAtAnyTimeWithoutATrace) {
  expect_ends_and_frames_leave_no_trace([](const System<double>& system) {
    return Subcycling(system, courant_steps_of_particles(system, 0.2));
  });
}

TEST(SubcyclingClocks, LeavesATrajectoryThatMeetsItself) {
  const Problem cube = spring_cube(5);
  Subcycling method(cube.system, courant_steps_of_particles(cube.system, 0.2));
  State<double> state = cube.start;
  Trajectory motion;
  ASSERT_EQ(record(method, state, 2.0, motion).outcome, Outcome::success);
  EXPECT_EQ(motion.end(), 2.0);
  EXPECT_NEAR((motion.at(2.0).position - state.position).norm(), 0, 1e-14);
  EXPECT_NEAR((motion.at(0.0).velocity - cube.start.velocity).norm(), 0, 1e-14);
}

TEST(SubcyclingClocks, EvaluatesWhatActsOnTheParticlesOfAClock) {
  // Of three springs two act on A at every step, two on B at every fourth; and all at the beginning, for both.
  const Problem chain = wall_chain();
  Subcycling method(chain.system, coarse_b(0.125, 4));
  State<double> state = chain.start;
  ASSERT_EQ(method.run(state, 2.0, {}).outcome, Outcome::success);
  EXPECT_EQ(method.work().steps, 16u);
  EXPECT_EQ(method.work().updates, 16u + 4u);
  EXPECT_EQ(method.work().element_coefficients, 2u * 17u + 2u * 5u);
}

// ---- what it refuses ---------------------------------------------------------------------------------------

TEST(SubcyclingClocks, RefusesForcesThatDependOnVelocities) {
  System<double> system(1, {1.0});
  system.add<Drag>({{0}}, {{0.2}});
  EXPECT_THAT([&] { Subcycling(system, {0.1}); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("drag depends on velocities"), HasSubstr("half a step after positions"))));
}

TEST(SubcyclingClocks, RefusesStepsThatAreNone) {
  const Problem chain = wall_chain();
  for (const ParticleSteps& steps :
       {ParticleSteps{}, ParticleSteps{0.1}, ParticleSteps{0.1, 0.0, 0.1, 0.1},
        ParticleSteps{0.1, -1.0, 0.1, 0.1}, ParticleSteps{0.1, HUGE_VAL, 0.1, 0.1}})
    EXPECT_THROW(Subcycling(chain.system, steps), std::invalid_argument);
  EXPECT_NO_THROW(Subcycling(chain.system, ParticleSteps{0.0, 0.1, 0.1, -1.0}));  // walls need none
  EXPECT_THROW(courant_steps_of_particles(chain.system, 1.5), std::invalid_argument);
  EXPECT_THROW(courant_steps_of_particles(planet(0.5).system, 0.1), std::invalid_argument);
}

TEST(SubcyclingClocks, RefusesEvents) {
  const Problem chain = wall_chain();
  Subcycling method(chain.system, coarse_b(0.1, 2));
  State<double> state = chain.start;
  RunOptions options;
  options.events = {{.name = "origin", .g = [](const auto&, const auto& x, const auto&) { return x(1, 0); }}};
  EXPECT_THAT([&] { method.run(state, 1.0, options); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("subcycling has one for each particle")));
}

TEST(SubcyclingClocks, TakesAShareOfTheLimitOfEachParticle) {
  // A: (101 + 2) from the spring to B, 101 from that to the wall; B: 103 as well, 2 from that to its wall.
  const ParticleSteps steps = courant_steps_of_particles(wall_chain().system, 0.5);
  EXPECT_NEAR(steps[1], 1 / std::sqrt(103.0), 1e-15);
  EXPECT_NEAR(steps[2], 1 / std::sqrt(103.0), 1e-15);
  const ParticleSteps longer = courant_steps_of_particles(chain_between_walls({100, 1, 1, 1}).system, 0.5);
  EXPECT_NEAR(longer[3], 1 / std::sqrt(4.0), 1e-15);
}

TEST(SubcyclingClocks, ReportsAMotionThatBlowsUpAndKeepsItsLastGoodState) {
  const Problem chain = wall_chain();
  Subcycling method(chain.system, coarse_b(1.0, 1.5));  // five times the limit
  State<double> state = chain.start;
  state.velocity(1, 0) = 0.1;
  RunOptions options;
  for (int i = 1; i < 1000; ++i) options.observer.frame_times.push_back(i / 3.0);
  options.observer.at_frame = [](const State<double>& frame) {
    EXPECT_TRUE(frame.position.allFinite() && frame.velocity.allFinite());
  };
  const Report report = method.run(state, 1e4, options);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_THAT(report.message, AllOf(HasSubstr("particle"), HasSubstr("t = "), HasSubstr("shorter steps")));
  EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
  EXPECT_GT(state.time, 50.0);
}

TEST(SubcyclingClocks, NeverGoesBackBehindTheStateThatItWasGiven) {
  // A free particle would pass 1e150 m in the step from t = 9: the impulse there fails, the last one is that at 8.
  Subcycling method(System<>(1, {1.0}), {1.0});
  State<double> state{0.0, Coordinates<>{{0}}, Coordinates<>{{1.05e149}}};
  ASSERT_EQ(method.run(state, 8.5, {}).outcome, Outcome::success);
  EXPECT_EQ(method.run(state, 20.0, {}).outcome, Outcome::non_finite);
  EXPECT_EQ(state.time, 8.5);
}

TEST(SubcyclingClocks, StopsAtTheLargestNumberOfStepsAndWhenAsked) {
  const Problem chain = wall_chain();
  RunOptions options;
  options.max_steps = 6;
  State<double> state = chain.start;
  EXPECT_EQ(Subcycling(chain.system, coarse_b(0.125, 3)).run(state, 10.0, options).outcome,
            Outcome::step_limit);
  EXPECT_EQ(state.time, 0.875);  // where the seventh impulse would come
  options = {};
  options.observer.after_step = [](const StepView& view) { return view.end() < 0.5; };
  state = chain.start;
  EXPECT_EQ(Subcycling(chain.system, coarse_b(0.125, 3)).run(state, 10.0, options).outcome,
            Outcome::interrupted);
  EXPECT_EQ(state.time, 0.5);
}

}  // namespace
}  // namespace jetlag::testing
