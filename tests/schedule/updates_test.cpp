// SPDX-License-Identifier: MIT
// What a run tells on its way: frames from the motion itself, and every update.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;

TEST(Updates, OfOneClockCoverTheRunWithoutGaps) {
  const Problem scene = spring_cube(1);
  Lockstep lockstep(taylor(scene.system, 5, std::make_unique<FixedStep>(0.3)));
  std::vector<double> known_until(8, 0.0);
  RunOptions options;
  options.observer.on_update = [&](const Update& update) {
    EXPECT_EQ(update.begin, known_until[update.particle]);
    EXPECT_EQ(update.degree, 5);
    known_until[update.particle] += update.step;
  };
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 2.0, options).outcome, Outcome::success);
  for (const double t : known_until)
    EXPECT_NEAR(t, 2.0, 1e-15);  // a rounding for each of 7 steps, most of them exact
  EXPECT_EQ(lockstep.work().updates, 8u * 7u);
}

TEST(Updates, HaveTheDegreesThatWereDrawn) {
  const Problem scene = spring_cube(1);
  Lockstep lockstep(std::make_unique<RandomTaylor>(scene.system, geometric(3, 6, 0.5),
                                                   std::make_unique<FixedStep>(0.1),
                                                   RandomTaylor::Options{.shared_draw = false}));
  std::uint64_t degrees = 0;
  std::set<int> seen;
  RunOptions options;
  options.observer.on_update = [&](const Update& update) {
    degrees += update.degree;
    seen.insert(update.degree);
  };
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 5.0, options).outcome, Outcome::success);
  EXPECT_EQ(degrees, lockstep.work().degrees);
  EXPECT_THAT(seen, ElementsAre(3, 4, 5, 6));
}

TEST(Frames, LieWhereTheyWereAskedForAndCropNoStep) {
  const Problem scene = oscillator();
  Lockstep lockstep(taylor(scene.system, 20, std::make_unique<FixedStep>(0.5)));
  std::vector<double> times;
  RunOptions options;
  options.observer.frame_times = {0.2, 0.4, 0.5, 1.7, 2.0};
  options.observer.at_frame = [&](const State<double>& state) {
    times.push_back(state.time);
    EXPECT_NEAR(state.position(0, 0), std::cos(state.time), 1e-15);
  };
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 2.0, options).outcome, Outcome::success);
  EXPECT_EQ(times, options.observer.frame_times);
  EXPECT_EQ(lockstep.work().steps, 4u);
}

}  // namespace
}  // namespace jetlag::testing
