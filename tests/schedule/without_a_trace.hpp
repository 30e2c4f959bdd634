// SPDX-License-Identifier: MIT
#pragma once
// What every schedule owes to whoever stops it or looks at it.

#include <gtest/gtest.h>

#include "jetlag/schedule/schedule.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {

/// A run to 1.23 and on to 3 gives the bits of a run to 3, and so does one that shows frames. make(system): a schedule.
template <class Make>
void expect_ends_and_frames_leave_no_trace(const Make& make) {
  const Problem cube = spring_cube(5);
  State<double> once = cube.start, twice = cube.start, watched = cube.start;
  auto first = make(cube.system), second = make(cube.system), third = make(cube.system);
  ASSERT_EQ(first.run(once, 3.0, {}).outcome, Outcome::success);
  ASSERT_EQ(second.run(twice, 1.23, {}).outcome, Outcome::success);
  EXPECT_EQ(twice.time, 1.23);
  ASSERT_EQ(second.run(twice, 3.0, {}).outcome, Outcome::success);
  RunOptions options;
  int frames = 0;
  options.observer.frame_times = {0.5, 1.23, 3.0};
  options.observer.at_frame = [&](const State<double>& state) {
    EXPECT_EQ(state.time, options.observer.frame_times[frames++]);
  };
  ASSERT_EQ(third.run(watched, 3.0, options).outcome, Outcome::success);
  EXPECT_EQ(frames, 3);
  EXPECT_EQ(once.position, twice.position);
  EXPECT_EQ(once.velocity, twice.velocity);
  EXPECT_EQ(once.position, watched.position);
}

}  // namespace jetlag::testing
