// SPDX-License-Identifier: MIT
// Block steps: one clock where all steps are equal, exact times, the same bits however a run is cut.

#include "jetlag/schedule/block.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"
#include "schedule/networks.hpp"

namespace jetlag::testing::block_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

BlockSteps::Options steps(double tolerance, double max_step = std::numeric_limits<double>::infinity()) {
  BlockSteps::Options options;
  options.tolerance = tolerance;
  options.max_step = max_step;
  return options;
}

double distance(const State<double>& a, const State<double>& b) {
  return std::max((a.position - b.position).cwiseAbs().maxCoeff(),
                  (a.velocity - b.velocity).cwiseAbs().maxCoeff());
}
bool same_bits(const State<double>& a, const State<double>& b) {
  return a.time == b.time && a.position == b.position && a.velocity == b.velocity;
}

TEST(BlockSteps, OfEqualLengthAreLockstep) {
  // The tolerance asks for nothing, all take max_step, 3 is no whole number of them: as the methods are the same, only
  // rounding differs, 1e-16 a step and less for each unit that the motion amplifies it by.
  const Problem scene = spring_cube(3);
  for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    for (int degree : {4, 9}) {
      RandomTaylor::Options one;
      one.velocity = velocity;
      State<double> lockstep = scene.start, block = scene.start;
      Lockstep(std::make_unique<RandomTaylor>(scene.system, fixed_degree(degree),
                                              std::make_unique<FixedStep>(0.07), one))
          .run(lockstep, 3.0, {});
      BlockSteps::Options options = steps(1e9, 0.07);
      options.velocity = velocity;
      BlockSteps schedule(scene.system, degree, options);
      ASSERT_EQ(schedule.run(block, 3.0, {}).outcome, Outcome::success);
      EXPECT_LT(distance(lockstep, block), 1e-14) << degree;
      EXPECT_EQ(schedule.work().steps, 43u);  // 42 of 0.07, and one for the rest
      EXPECT_EQ(schedule.work().updates, 43u * 8u);
    }
}

TEST(BlockSteps, ChooseLevelsThatNestAndAreAtMostOneCoarserThanANeighbours) {
  constexpr int moving = 32;
  const Problem scene = stiff_spot_in_a_chain(moving, 1e4);
  for (int grading : {1, 2}) {
    State<double> state = scene.start;
    BlockSteps::Options options = steps(1e-9);
    options.grading = grading;
    BlockSteps schedule(scene.system, 8, options);
    int finest = 0, coarsest = 99, worst = 0;
    std::vector<std::uint64_t> updates(moving + 2, 0);
    RunOptions run;
    run.observer.after_step = [&](const StepView& view) {
      for (int i = 1; i <= moving; ++i) {
        finest = std::max(finest, schedule.level_of(i));
        coarsest = std::min(coarsest, schedule.level_of(i));
        if (std::exchange(updates[i], schedule.updates_of(i)) == schedule.updates_of(i)) continue;
        // The longest step is the run, 1 s: a step of level l begins at a multiple of 2^-l.
        const double begin = std::ldexp(view.begin(), schedule.level_of(i));
        EXPECT_EQ(begin, std::round(begin));
        for (int n : {i - 1, i + 1})
          if (n >= 1 && n <= moving) worst = std::max(worst, schedule.level_of(n) - schedule.level_of(i));
      }
      return true;
    };
    ASSERT_EQ(schedule.run(state, 1.0, run).outcome, Outcome::success);
    EXPECT_EQ(worst, grading);
    EXPECT_GE(finest - coarsest, 5);  // frequencies from 2 to 200
  }
}

TEST(BlockSteps, EndAndShowFramesAtTheGivenTimes) {
  // The state at a frame is that of a run that ends there.
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  RunOptions options;
  options.observer.frame_times = {0.1, 1.0 / 3.0, 0.7, 0.9};
  std::vector<State<double>> frames;
  options.observer.at_frame = [&](const State<double>& state) { frames.push_back(state); };
  State<double> state = scene.start;
  BlockSteps schedule(scene.system, 8, steps(1e-9, 0.25));
  ASSERT_EQ(schedule.run(state, 0.9, options).outcome, Outcome::success);
  EXPECT_EQ(state.time, 0.9);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_TRUE(same_bits(frames.back(), state));
  for (int i = 0; i < 3; ++i) {
    State<double> until = scene.start;
    BlockSteps(scene.system, 8, steps(1e-9, 0.25)).run(until, options.observer.frame_times[i], {});
    EXPECT_EQ(frames[i].time, options.observer.frame_times[i]);
    EXPECT_LT(distance(frames[i], until), 1e-14);
  }
}

TEST(BlockSteps, CountTicksExactlyAtLargeTimes) {
  // At 1e9 s an ulp is 1.2e-7 s, and a time kept as a double would be off by as much at each step: by 1e-8 s after a
  // few, and the motion with it. The law does not depend on time: the run is the one from 0. `until` is exact there.
  Problem scene = stiff_spot_in_a_chain(16, 1e3);
  State<double> near = scene.start, far = scene.start;
  far.time = 1e9;
  BlockSteps(scene.system, 8, steps(1e-9, 0.01)).run(near, 2.0, {});
  ASSERT_EQ(BlockSteps(scene.system, 8, steps(1e-9, 0.01)).run(far, 1e9 + 2.0, {}).outcome, Outcome::success);
  EXPECT_EQ(far.time, 1e9 + 2.0);
  EXPECT_EQ(far.position, near.position);
  EXPECT_EQ(far.velocity, near.velocity);
}

TEST(BlockSteps, GiveTheSameBitsHoweverARunIsCut) {
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  const auto schedule = [&] { return BlockSteps(scene.system, 8, steps(1e-9, 0.5)); };
  State<double> whole = scene.start;
  schedule().run(whole, 2.0, {});

  State<double> stopped = scene.start;
  BlockSteps by_count = schedule();
  RunOptions few;
  few.max_steps = 7;
  int stops = 0;
  while (by_count.run(stopped, 2.0, few).outcome == Outcome::step_limit) ++stops;
  EXPECT_GT(stops, 5);
  EXPECT_TRUE(same_bits(stopped, whole));

  State<double> interrupted = scene.start;
  BlockSteps by_observer = schedule();
  RunOptions one;
  one.observer.after_step = [](const StepView&) { return false; };
  while (by_observer.run(interrupted, 2.0, one).outcome == Outcome::interrupted) ++stops;
  EXPECT_TRUE(same_bits(interrupted, whole));
}

TEST(BlockSteps, BeginAnewFromAStateThatIsNotTheirs) {
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  State<double> state = scene.start;
  BlockSteps used(scene.system, 8, steps(1e-9, 0.5)), fresh(scene.system, 8, steps(1e-9, 0.5));
  used.run(state, 0.3, {});
  state.velocity(3, 0) += 0.1;
  State<double> again = state;
  used.run(state, 1.0, {});
  fresh.run(again, 1.0, {});
  EXPECT_TRUE(same_bits(state, again));
}

TEST(BlockSteps, GiveTheSameBitsForAnyNumberOfThreadsAndOrderOfParticles) {
  const Problem scene = stiff_spot_in_a_chain(40, 1e4);
  const auto end = [](const Problem& scene, int threads) {
    BlockSteps::Options options = steps(1e-8);
    options.threads = threads;
    State<double> state = scene.start;
    BlockSteps(scene.system, 6, options).run(state, 0.5, {});
    return state;
  };
  const State<double> one = end(scene, 1);
  EXPECT_TRUE(same_bits(end(scene, 2), one));

  // The same elements in the same order, between particles of other numbers.
  const int particles = scene.system.particles();
  std::vector<int> number(particles);
  for (int i = 0; i < particles; ++i)
    number[i] = (i * 29 + 11) % particles;  // 29 and 42 have no common divisor
  const State<double> other = end(renumbered(scene, number), 1);
  for (int i = 0; i < particles; ++i) {
    EXPECT_EQ(other.position(number[i], 0), one.position(i, 0)) << i;
    EXPECT_EQ(other.velocity(number[i], 0), one.velocity(i, 0)) << i;
  }
}

TEST(BlockSteps, RecordAMotionWithoutJumps) {
  // Between updates the motion is the polynomials re-expanded; each piece begins where the one before ends.
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  State<double> state = scene.start;
  BlockSteps schedule(scene.system, 10, steps(1e-11));
  Trajectory motion;
  ASSERT_EQ(record(schedule, state, 1.0, motion).outcome, Outcome::success);
  EXPECT_LT(distance(motion.at(1.0), state), 1e-13);
  for (std::size_t p = 1; p < motion.size(); ++p) {
    const PieceView piece = motion.piece(p);
    EXPECT_LT(distance(motion.piece(p - 1).at(piece.begin), piece.at(piece.begin)), 1e-13);
  }
}

TEST(BlockSteps, RecordTheSameMotionHoweverARunIsCut) {
  // A run that goes on between two updates shows its observer the rest of that step first.
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  State<double> whole = scene.start, cut = scene.start;
  BlockSteps at_once(scene.system, 10, steps(1e-11, 0.25)), in_parts(scene.system, 10, steps(1e-11, 0.25));
  Trajectory one, parts;
  ASSERT_EQ(record(at_once, whole, 1.0, one).outcome, Outcome::success);
  for (const double until : {0.123, 0.5, 0.777, 1.0})
    ASSERT_EQ(record(in_parts, cut, until, parts).outcome, Outcome::success);
  EXPECT_GT(parts.size(), one.size());
  for (int k = 0; k <= 100; ++k) EXPECT_LT(distance(one.at(0.01 * k), parts.at(0.01 * k)), 1e-13) << k;
}

TEST(BlockSteps, DrawTheirDegreesLikeLockstep) {
  // Equal steps and one draw for all: the same numbers as RandomTaylor draws, so that the same terms count.
  const Problem scene = spring_cube(5);
  State<double> lockstep = scene.start, block = scene.start;
  Lockstep(
      std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5), std::make_unique<FixedStep>(0.05)))
      .run(lockstep, 1.0, {});
  BlockSteps schedule(scene.system, geometric(3, 8, 0.5), steps(1e9, 0.05));
  ASSERT_EQ(schedule.run(block, 1.0, {}).outcome, Outcome::success);
  EXPECT_LT(distance(lockstep, block), 1e-14);
  EXPECT_LT(schedule.work().mean_degree(), 6);
}

TEST(BlockSteps, MoveNothingWhereNothingMoves) {
  System<double> system(1, {1.0});
  system.fix(0);
  State<double> state{0.0, Coordinates<double>::Ones(1, 1), Coordinates<double>::Zero(1, 1)};
  ASSERT_EQ(BlockSteps(system, 4, {}).run(state, 5.0, {}).outcome, Outcome::success);
  EXPECT_EQ(state.time, 5.0);
  EXPECT_EQ(state.position(0, 0), 1.0);
}

TEST(BlockSteps, FollowAFreeFallInOneStep) {
  const Problem scene = free_fall();
  State<double> state = scene.start;
  BlockSteps schedule(scene.system, 4, {});
  ASSERT_EQ(schedule.run(state, 2.0, {}).outcome, Outcome::success);
  EXPECT_EQ(schedule.work().steps, 1u);
  EXPECT_EQ(state.position(0, 2), 3.0 + 4.0 * 2 - 9.75 * 2);
}

TEST(BlockSteps, SayWhatIsWrong) {
  const Problem scene = spring_cube(3);
  BlockSteps::Options options = steps(0.0);
  EXPECT_THAT([&] { BlockSteps(scene.system, 4, options); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("tolerance")));
  options = steps(1e-9);
  options.grading = -1;
  EXPECT_THAT([&] { BlockSteps(scene.system, 4, options); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("grading")));
  RunOptions run;
  run.events = {{.name = "floor", .g = [](const auto&, const auto& x, const auto&) { return x(0, 1); }}};
  State<double> state = scene.start;
  EXPECT_THAT([&] { BlockSteps(scene.system, 4, {}).run(state, 1.0, run); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("events")));
}

}  // namespace
}  // namespace jetlag::testing::block_test
