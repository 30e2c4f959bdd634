// SPDX-License-Identifier: MIT
// One clock: it ends where it should, does not drift, and says how a run ended.

#include "jetlag/schedule/lockstep.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Lockstep taylor_in_steps(const Problem& scene, double step) {
  return Lockstep(taylor(scene.system, 4, std::make_unique<FixedStep>(step)));
}
Lockstep leapfrog_in_steps(const Problem& scene, double step) {
  return Lockstep(std::make_unique<Leapfrog>(scene.system, step));
}

bool is_finite(const State<double>& state) {
  return std::isfinite(state.time) && state.position.allFinite() && state.velocity.allFinite();
}

TEST(Lockstep, EndsAtTheGivenTimeToTheLastBit) {
  const Problem scene = oscillator();
  for (double step : {0.1, 0.01, 1.0 / 3.0, 0.0625, 0.3, 0.7, 5.0})
    for (double until : {1.0, 0.7, 3.3, 1.0 / 7.0, 10.0}) {
      State<double> state = scene.start;
      EXPECT_EQ(taylor_in_steps(scene, step).run(state, until, {}).outcome, Outcome::success);
      EXPECT_EQ(state.time, until) << "step " << step;
      state = scene.start;
      EXPECT_EQ(leapfrog_in_steps(scene, step).run(state, until, {}).outcome, Outcome::success);
      EXPECT_EQ(state.time, until) << "step " << step;
    }
}

TEST(Lockstep, EndsAtTheGivenTimeFromNegativeTimes) {
  // -3 + (0.1 - -3) is not 0.1 in doubles: the end is set, not added up.
  Problem scene = oscillator();
  scene.start.time = -3.0;
  ASSERT_NE(-3.0 + (0.1 - -3.0), 0.1);
  State<double> state = scene.start;
  EXPECT_EQ(taylor_in_steps(scene, 5.0).run(state, 0.1, {}).outcome, Outcome::success);
  EXPECT_EQ(state.time, 0.1);
}

TEST(Lockstep, TakesNoMoreStepsThanDivideTheTime) {
  const Problem scene = oscillator();
  struct Case {
    double step, until;
    std::uint64_t steps;
  };
  for (const Case& c : {Case{0.1, 1.0, 10},
                        {0.01, 1.0, 100},
                        {0.1, 0.7, 7},
                        {1e-4, 1.0, 10000},
                        {1.0 / 3, 1.0, 3},
                        {0.3, 1.0, 4},
                        {0.7, 1.0, 2},
                        {2.0, 1.0, 1},
                        {0.1, 100.0, 1000}}) {
    State<double> state = scene.start;
    Lockstep lockstep = taylor_in_steps(scene, c.step);
    ASSERT_EQ(lockstep.run(state, c.until, {}).outcome, Outcome::success);
    EXPECT_EQ(lockstep.work().steps, c.steps) << c.step << " up to " << c.until;
  }
}

TEST(Lockstep, HasAClockThatDoesNotDrift) {
  // At t = 1e9 a double has steps of 1.2e-7: added one by one, a thousand steps of 1e-3 would be off by some
  // 400 of them. Compensated, every time is the nearest double to the truth or one beside it.
  const double begin = 1e9, step = 1e-3, grain = std::nextafter(begin, 2 * begin) - begin;
  Problem scene = oscillator();
  scene.start.time = begin;
  Lockstep lockstep = taylor_in_steps(scene, step);
  State<double> state = scene.start;
  int n = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    EXPECT_LE(std::abs((view.end() - begin) - step * ++n), grain);
    return true;
  };
  ASSERT_EQ(lockstep.run(state, begin + 1, options).outcome, Outcome::success);
  EXPECT_EQ(state.time, begin + 1);
  EXPECT_EQ(n, 1000);
  // The steps were of 1e-3, not rounded: the error is that of the method, h^4 / 5!, and 1000 roundings.
  EXPECT_NEAR(state.position(0, 0), std::cos(1.0), 1e-12);
}

TEST(Lockstep, CropsTheLastStepToTheTimeThatIsLeft) {
  // 0.3 + 0.3 + 0.3 + 0.1 at t = 1e9, where the clock shows multiples of 1.2e-7: the motion has passed
  // exactly 1, by degree 20, with a few roundings.
  Problem scene = oscillator();
  scene.start.time = 1e9;
  State<double> state = scene.start;
  Lockstep lockstep(taylor(scene.system, 20, std::make_unique<FixedStep>(0.3)));
  ASSERT_EQ(lockstep.run(state, 1e9 + 1, {}).outcome, Outcome::success);
  EXPECT_EQ(lockstep.work().steps, 4u);
  EXPECT_NEAR(state.position(0, 0), std::cos(1.0), 1e-15);
  EXPECT_NEAR(state.velocity(0, 0), -std::sin(1.0), 1e-15);
}

TEST(Lockstep, DoesNothingWhereNoTimeIsLeft) {
  const Problem scene = oscillator();
  Lockstep lockstep = taylor_in_steps(scene, 0.1);
  State<double> state = scene.start;
  EXPECT_EQ(lockstep.run(state, 0.0, {}).outcome, Outcome::success);
  EXPECT_EQ(lockstep.work().steps, 0u);
  EXPECT_EQ(state.position, scene.start.position);
}

TEST(Lockstep, RefusesToRunBackwards) {
  const Problem scene = oscillator();
  Lockstep lockstep = taylor_in_steps(scene, 0.1);
  State<double> state = scene.start;
  EXPECT_THROW(lockstep.run(state, -1.0, {}), std::invalid_argument);
  EXPECT_THROW(lockstep.run(state, std::numeric_limits<double>::quiet_NaN(), {}), std::invalid_argument);
}

TEST(Lockstep, ShowsEveryStepToTheObserver) {
  const Problem scene = oscillator();
  Lockstep lockstep = taylor_in_steps(scene, 0.3);
  State<double> state = scene.start;
  double last = 0.0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    EXPECT_EQ(view.begin(), last);
    last = view.end();
    EXPECT_EQ(view.piece().begin, view.begin());
    EXPECT_NEAR(view.piece().end, view.end(), 1e-15);  // one rounding of a time up to 1
    return true;
  };
  ASSERT_EQ(lockstep.run(state, 1.0, options).outcome, Outcome::success);
  EXPECT_EQ(last, 1.0);
}

TEST(Lockstep, ContinuesWhereItStopped) {
  // Two runs of five steps are one run of ten, to the last bit: the times are the same doubles here.
  const Problem scene = spring_cube(1);
  const auto random = [&] {
    return Lockstep(std::make_unique<RandomTaylor>(scene.system, geometric(3, 6, 0.5),
                                                   std::make_unique<FixedStep>(0.125)));
  };
  State<double> once = scene.start, twice = scene.start;
  ASSERT_EQ(random().run(once, 1.25, {}).outcome, Outcome::success);
  Lockstep lockstep = random();
  ASSERT_EQ(lockstep.run(twice, 0.625, {}).outcome, Outcome::success);
  ASSERT_EQ(lockstep.run(twice, 1.25, {}).outcome, Outcome::success);
  EXPECT_EQ(once.position, twice.position) << "seed 1";
  EXPECT_EQ(once.velocity, twice.velocity) << "seed 1";
}

// ---- outcomes ---------------------------------------------------------------------------------------------

TEST(Lockstep, StopsAtTheLargestNumberOfSteps) {
  const Problem scene = oscillator();
  Lockstep lockstep = taylor_in_steps(scene, 0.125);
  State<double> state = scene.start;
  RunOptions options;
  options.max_steps = 6;
  const Report report = lockstep.run(state, 10.0, options);
  EXPECT_EQ(report.outcome, Outcome::step_limit);
  EXPECT_THAT(report.message, AllOf(HasSubstr("6"), HasSubstr("0.75")));
  EXPECT_EQ(state.time, 0.75);
  EXPECT_EQ(lockstep.work().steps, 6u);
  EXPECT_NEAR(state.position(0, 0), std::cos(0.75), 1e-5);
}

TEST(Lockstep, SaysHowManyStepsEachRunTook) {
  const Problem scene = oscillator();
  Lockstep method = taylor_in_steps(scene, 0.125);
  State<double> state = scene.start;
  EXPECT_EQ(method.run(state, 1.0, {}).steps, 8u);
  EXPECT_EQ(method.run(state, 1.25, {}).steps, 2u);
  const Report limited = method.run(state, 2.0, {.max_steps = 3});
  EXPECT_EQ(limited.outcome, Outcome::step_limit);
  EXPECT_EQ(limited.steps, 3u);
  EXPECT_EQ(method.run(state, state.time, {}).steps, 0u);
}

TEST(Lockstep, MayUseUpItsStepsExactly) {
  const Problem scene = oscillator();
  State<double> state = scene.start;
  RunOptions options;
  options.max_steps = 8;
  EXPECT_EQ(taylor_in_steps(scene, 0.125).run(state, 1.0, options).outcome, Outcome::success);
}

TEST(Lockstep, StopsWhenAsked) {
  const Problem scene = oscillator();
  Lockstep lockstep = taylor_in_steps(scene, 0.125);
  State<double> state = scene.start;
  RunOptions options;
  options.observer.after_step = [](const StepView& view) { return view.end() < 0.5; };
  const Report report = lockstep.run(state, 10.0, options);
  EXPECT_EQ(report.outcome, Outcome::interrupted);
  EXPECT_THAT(report.message, HasSubstr("0.5"));
  EXPECT_EQ(state.time, 0.5);
  EXPECT_EQ(report.steps, 4u);
}

/// Two bodies at rest fall together, by degree 20 and Jorba-Zou, from time `begin`.
struct Collision {
  Report report;
  State<double> state;
};
Collision collision(double begin) {
  Problem scene = falling_together(1.0);
  scene.start.time = begin;
  Lockstep lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
  Collision c{{}, scene.start};
  c.report = lockstep.run(c.state, begin + 10.0, {});
  return c;
}

TEST(Lockstep, ReportsACollisionAsUnderflow) {
  // The control follows the fall until the step no longer changes the time: there doubles lie 1.1e-13 apart.
  const auto [report, state] = collision(1000.0);
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  EXPECT_EQ(report.particle, 0);  // the lighter one is the fastest
  EXPECT_THAT(report.message, AllOf(HasSubstr("particle 0"), HasSubstr("t = 1000.555"), HasSubstr("soften")));
  EXPECT_TRUE(is_finite(state));
  // A step is e^-2 of the time left: the last one is above half of that, and 8 times as much is left.
  EXPECT_NEAR(state.time, 1000.0 + time_of_collision(1.0), 1e-12);
}

TEST(Lockstep, FollowsACollisionThroughCoefficientsBeyondDoubles) {
  // Near 0.55 time is resolved so finely that coefficient k ~ (time left)^(2/3 - k) would overflow in
  // seconds: at k = 20 with 1e-16 left. The series is counted in another unit, and it is the time that ends
  // the run.
  const auto [report, state] = collision(0.0);
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  EXPECT_EQ(report.particle, 0);
  EXPECT_THAT(report.message, AllOf(HasSubstr("particle 0"), HasSubstr("t = 0.555")));
  EXPECT_TRUE(is_finite(state));
  // Some 1e-15 left, and a relative energy error below 1e-13, which is 3/2 of it in time.
  EXPECT_NEAR(state.time, time_of_collision(1.0), 1e-13);
}

TEST(Lockstep, ReportsCoincidentParticlesAsNonFinite) {
  Problem scene = falling_together(1.0);
  scene.start.time = 0.25;
  scene.start.position.setConstant(3.0);
  const State<double> before = scene.start;
  for (int method = 0; method < 3; ++method) {
    State<double> state = scene.start;
    Lockstep lockstep = method == 0   ? taylor_in_steps(scene, 0.125)
                        : method == 1 ? leapfrog_in_steps(scene, 0.125)
                                      : Lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
    const Report report = lockstep.run(state, 10.0, {});
    EXPECT_EQ(report.outcome, Outcome::non_finite);
    EXPECT_EQ(report.particle, 0);
    EXPECT_THAT(report.message, AllOf(HasSubstr("coefficient 2 of the motion of particle 0"),
                                      HasSubstr("t = 0.25"), HasSubstr("coincide")));
    EXPECT_EQ(state.time, before.time);
    EXPECT_EQ(state.position, before.position);
    EXPECT_EQ(state.velocity, before.velocity);
    EXPECT_EQ(lockstep.work().steps, 0u);
  }
}

TEST(Lockstep, ReportsASpringWithoutLengthAsNonFinite) {
  System<double> system(2, {1.0, 1.0, 1.0});
  system.add<Spring>({{0, 1}, {1, 2}}, {{1.0, 1.0}});
  Problem scene{std::move(system), {0.0, Coordinates<double>::Zero(3, 2), Coordinates<double>::Zero(3, 2)}};
  scene.start.position(0, 0) = 1.0;  // particles 1 and 2 coincide
  State<double> state = scene.start;
  const Report report = taylor_in_steps(scene, 0.125).run(state, 1.0, {});
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_EQ(report.particle, 1);
  EXPECT_EQ(state.position, scene.start.position);
}

TEST(Lockstep, ReportsAMotionThatBlowsUpAndKeepsItsLastGoodState) {
  // Steps of 10 on an oscillator of frequency 1 multiply it by some 400 each (Taylor 4) or 100 (leapfrog).
  const Problem scene = oscillator();
  for (bool leap : {false, true}) {
    State<double> state = scene.start, last = scene.start;
    RunOptions options;
    options.observer.after_step = [&](const StepView& view) {
      last = view.state();
      return true;
    };
    Lockstep lockstep = leap ? leapfrog_in_steps(scene, 10.0) : taylor_in_steps(scene, 10.0);
    const Report report = lockstep.run(state, 1e4, options);
    EXPECT_EQ(report.outcome, Outcome::non_finite);
    EXPECT_EQ(report.particle, 0);
    EXPECT_THAT(report.message, AllOf(HasSubstr("particle 0"), HasSubstr("t = "), HasSubstr("shorter step")));
    EXPECT_TRUE(is_finite(state));
    EXPECT_EQ(state.time, last.time);
    EXPECT_EQ(state.position, last.position);
    EXPECT_EQ(state.velocity, last.velocity);
    EXPECT_GT(lockstep.work().steps, 50u);
  }
}

TEST(Lockstep, ReportsAStepThatDoesNotChangeTheTime) {
  Problem scene = oscillator();
  scene.start.time = 1.0;
  for (bool leap : {false, true}) {
    State<double> state = scene.start;
    const Report report =
        (leap ? leapfrog_in_steps(scene, 1e-17) : taylor_in_steps(scene, 1e-17)).run(state, 2.0, {});
    EXPECT_EQ(report.outcome, Outcome::step_underflow);
    EXPECT_EQ(report.particle, 0);
    EXPECT_THAT(report.message, AllOf(HasSubstr("1e-17"), HasSubstr("t = 1 "), HasSubstr("particle 0")));
    EXPECT_EQ(state.time, 1.0);
    EXPECT_EQ(state.position, scene.start.position);
  }
}

}  // namespace
}  // namespace jetlag::testing
