// SPDX-License-Identifier: MIT
// Where a floor points that is not told: up, against what pulls.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/runs/run_scene.hpp"

namespace jetlag::testing {
namespace {

std::string scene_with(int dimension, const std::string& forces) {
  const std::string position = dimension == 1 ? "[1]" : dimension == 2 ? "[1, 1]" : "[1, 1, 1]";
  return R"({"dimension": )" + std::to_string(dimension) + R"(, "particles": {"position": [)" + position +
         R"(]}, "until": 2, "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 0.001}, "forces": [)" +
         forces + "]}";
}

/// The normal of the floor of a scene, the first so many numbers.
std::vector<double> normal_of(int dimension, const std::string& forces) {
  const Scene scene = read_scene(scene_with(dimension, forces), "test", ".");
  for (const auto& group : scene.system->elements())
    if (group.law.name == "floor" || group.law.name == "quadratic_floor")
      return {group.parameters.begin() + 2, group.parameters.begin() + 2 + dimension};
  return {};
}

const std::string ground = R"({"type": "floor", "stiffness": 10000})";
std::string field(const std::string& g) { return R"({"type": "uniform_field", "acceleration": )" + g + "}"; }
using Normal = std::vector<double>;

TEST(FloorInScenes, PointsAgainstTheField) {
  const std::string down = field("[0, 0, -9.8]");
  EXPECT_EQ(normal_of(3, down + ", " + ground), (Normal{0, 0, 1}));
  EXPECT_EQ(normal_of(3, ground + ", " + down), (Normal{0, 0, 1}));
  EXPECT_EQ(normal_of(3, field("[0, -9.81, 0]") + ", " + ground), (Normal{0, 1, 0}));
  EXPECT_EQ(normal_of(2, field("[3, -4]") + ", " + ground), (Normal{-0.6, 0.8}));
  EXPECT_EQ(normal_of(1, field("[9.8]") + ", " + ground), (Normal{-1}));
  EXPECT_EQ(normal_of(2, field("[0, -1]") + ", " + field("[1, 1]") + ", " + ground), (Normal{-1, 0}));
}

TEST(FloorInScenes, PointsAlongTheSecondAxisWhereNothingPulls) {
  for (const char* none : {"[0, 0, 0]", ""}) {
    const std::string pull = *none ? field(none) + ", " : "";
    EXPECT_EQ(normal_of(3, pull + ground), (Normal{0, 1, 0}));
  }
  EXPECT_EQ(normal_of(1, ground), (Normal{1}));
}

TEST(FloorInScenes, PointsUpInPicturesToo) {  // to the axis next to it
  using Axis = std::array<int, 3>;
  const auto up = [](const std::string& forces) {
    return read_scene(scene_with(3, forces), "test", ".").shape.up;
  };
  EXPECT_EQ(up(""), (Axis{0, 1, 0}));
  EXPECT_EQ(up(field("[1, -9.8, 2]")), (Axis{0, 1, 0}));
  EXPECT_EQ(up(field("[1, 0, -9.8]")), (Axis{0, 0, 1}));
  EXPECT_EQ(up(field("[9.8, 0, 0]")), (Axis{-1, 0, 0}));
  EXPECT_EQ(up(R"({"type": "floor", "stiffness": 1, "normal": [0, 0, 1]})"), (Axis{0, 0, 1}));
}

TEST(FloorInScenes, PointsWhereItIsTold) {
  EXPECT_EQ(
      normal_of(3, field("[0, 0, -9.8]") + R"(, {"type": "floor", "stiffness": 10000, "normal": [2, 0, 0]})"),
      (Normal{1, 0, 0}));
}

TEST(FloorInScenes, SignsOfZerosAreThoseOfBefore) {
  for (const double x : normal_of(3, field("[0, -9.8, 0]") + ", " + ground)) EXPECT_FALSE(std::signbit(x));
}

TEST(FloorInScenes,
     HoldsWhatFallsAlongZ) {  // from 1 m at v = 0: it comes back from a depth of sqrt(2 m g h / k) = 4 cm
  const RunResult result =
      run_scene(read_scene(scene_with(3, field("[0, 0, -9.8]") + ", " + ground), "test", "."));
  EXPECT_GT(result.summary.position(0, 2), -0.05);
}

}  // namespace
}  // namespace jetlag::testing
