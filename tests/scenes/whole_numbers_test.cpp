// SPDX-License-Identifier: MIT
// Whole numbers as programs write them that know no others than those with a point.
#include <gtest/gtest.h>

#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing {
namespace {

TEST(WholeNumbers, MayBeWrittenWithAPoint) {
  const Scene scene = read_scene(R"({"dimension": 2.0, "seed": 1e3,
      "particles": {"position": [[0, 0], [1, 0]], "fixed": [1.0]},
      "forces": [{"type": "spring", "pairs": [[0.0, 1.0]], "stiffness": 1, "rest_length": 0.5}],
      "integrator": {"type": "taylor", "degree": 20.0}, "control": {"type": "jorba_zou"},
      "until": 1, "output": {"frames": 3.0, "pictures": false}})",
                                 "test", ".");
  EXPECT_EQ(scene.system->dimension(), 2);
  EXPECT_EQ(scene.seed, 1000u);
  EXPECT_EQ(scene.output.frames, 3);
  EXPECT_TRUE(scene.system->fixed()[1]);
}

}  // namespace
}  // namespace jetlag::testing
