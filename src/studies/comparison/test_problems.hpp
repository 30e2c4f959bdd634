// SPDX-License-Identifier: MIT
#pragma once
// Problems on which methods are compared: those of the room, and scenes, with the ends that a series of high degree finds.

#include <vector>

#include "jetlag/scenes/scene.hpp"
#include "problems/problem.hpp"

namespace jetlag {

struct TestProblemEntry {
  const char *name, *description;
  problems::Problem (*make)();
};
const std::vector<TestProblemEntry>& test_problems();

/// The motion of a scene, its method aside, with its end.   Throws std::runtime_error where that is not found.
problems::Problem problem_of(const Scene& scene);

}  // namespace jetlag
