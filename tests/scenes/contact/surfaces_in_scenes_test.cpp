// SPDX-License-Identifier: MIT
// What touches in a scene: the surface that a word stands for, and obstacles.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "jetlag/contact/clearance.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "scenes/contact/contact_scenes.hpp"
#include "support/program.hpp"

namespace jetlag::testing::surfaces_in_scenes_test {
namespace {

using contact_scenes::barrier, contact_scenes::scene;
using ::testing::Each;
using ::testing::Pair;

/// Thrown at a wall of one triangle at z = 0 by 1 m/s, whatever touches it comes back with that.
Coordinates<double> velocity_after(const std::string& particles, const std::string& surface) {
  const std::string wall =
      R"("obstacles": [{"position": [[-9, -9, 0], [9, -9, 0], [0, 18, 0]], "triangles": [[0, 1, 2]]}])";
  const RunResult result = run_scene(scene(3, particles, barrier(surface), wall));
  EXPECT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  return result.summary.velocity;
}

TEST(SurfacesInScenes, ArePointsListedOrAll) {
  const std::string three =
      R"({"position": [[-1, 0, 0.3], [0, 0, 0.3], [1, 0, 0.3]], "velocity": [0, 0, -1]})";
  const auto v = velocity_after(three, R"("points": [0, 2])");
  EXPECT_NEAR(v(0, 2), 1, 1e-6);
  EXPECT_NEAR(v(1, 2), -1, 1e-15);
  EXPECT_NEAR(v(2, 2), 1, 1e-6);
  EXPECT_NEAR(velocity_after(three, R"("surface": "points")")(1, 2), 1, 1e-6);
}

/// The features of the surface of a scene, by the pairs that its boundary keeps apart: a probe is an obstacle at a place.
bool touches(int dimension, const std::string& particles, const std::string& place) {
  try {
    scene(dimension, particles, barrier(), R"("obstacles": [{"position": [)" + place + "]}]");
  } catch (const std::exception&) {
    return true;
  }
  return false;
}

TEST(SurfacesInScenes, AreFacesOfABody) {
  const std::string cube = R"({"box": {"lengths": [2, 2, 2], "cells": [2, 2, 2]}})";
  for (const char* outside : {"[0.6, 0.3, 0]", "[0.6, 0.3, 2]", "[0, 0.6, 0.3]", "[2, 0.6, 0.3]"})
    EXPECT_TRUE(touches(3, cube, outside)) << outside;
  EXPECT_FALSE(touches(3, cube, "[1, 0.6, 0.3]"));
  EXPECT_FALSE(touches(3, cube, "[1, 1, 1]"));  // a vertex inside
}

TEST(SurfacesInScenes, AreTheOutsideOfAGrid) {
  const std::string net = R"({"grid": [3, 3], "spacing": 1})", block = R"({"grid": [3, 3, 3], "spacing": 1})",
                    row = R"({"grid": [3], "spacing": 1})";
  for (const char* inside : {"[0.2, 0.7, 0]", "[0.7, 0.2, 0]", "[1.2, 1.7, 0]"})
    EXPECT_TRUE(touches(3, net, inside)) << inside;
  for (const char* face :
       {"[0.2, 0.7, 0]", "[0.2, 0.7, 2]", "[0, 0.2, 0.7]", "[2, 0.2, 0.7]", "[0.2, 0, 0.7]", "[1.7, 2, 0.2]"})
    EXPECT_TRUE(touches(3, block, face)) << face;
  EXPECT_FALSE(touches(3, block, "[1, 0.2, 0.7]"));
  EXPECT_FALSE(touches(3, block, "[1, 1, 1]"));
  for (const char* border : {"[0.3, 0]", "[0, 0.3]", "[2, 1.3]", "[1.3, 2]"})
    EXPECT_TRUE(touches(2, net, border)) << border;
  EXPECT_FALSE(touches(2, net, "[1, 0.5]"));
  EXPECT_TRUE(touches(2, row, "[0.3, 0]"));
  EXPECT_TRUE(touches(3, row, "[1.3, 0, 0]"));
}

TEST(SurfacesInScenes, AreBordersInThePlaneAndPointsOnALine) {
  const std::string plate = R"({"box": {"lengths": [2, 2], "cells": [2, 2]}})";
  EXPECT_TRUE(touches(2, plate, "[0.3, 0]"));
  EXPECT_TRUE(touches(2, plate, "[2, 0.3]"));
  EXPECT_FALSE(touches(2, plate, "[1, 0.5]"));
  EXPECT_FALSE(touches(2, plate, "[1, 1]"));
  EXPECT_TRUE(touches(1, R"({"grid": [3], "spacing": 1})", "[1]"));
}

TEST(SurfacesInScenes, AreSheetsAndFilesToo) {
  EXPECT_TRUE(touches(3, R"({"sheet": {"lengths": [2, 2], "cells": [2, 2]}})", "[1.1, 0.3, 0]"));
}

// ---- obstacles ---------------------------------------------------------------------------------------------------

constexpr const char* ball = R"({"position": [[0, 0, 3]], "velocity": [[0, 0, -2]]})";

TEST(Obstacles, AreFixedParticlesAfterTheOthersAndNotInSums) {
  const Scene s = scene(
      3, R"({"position": [[0, 0, 3], [0, 1, 3]], "velocity": [0.5, 0, 0], "mass": 2})",
      barrier(R"("surface": "points")") + R"(, {"type": "gravity"}, {"type": "drag", "coefficient": [0, 0]},
                        {"type": "uniform_field", "acceleration": [0, 0, -1]})",
      R"("obstacles": [{"sphere": {"radius": 1, "cells": 2}}, {"position": [[5, 5, 5]]}])");
  EXPECT_EQ(s.system->particles(), 2 + 42 + 1);
  EXPECT_FALSE(s.system->fixed()[1]);
  for (int i = 2; i < 45; ++i) EXPECT_TRUE(s.system->fixed()[i]);
  EXPECT_EQ(momentum(*s.system, s.initial)[0], 2.0);
  for (const auto& group : s.system->elements()) {
    if (group.law.name == "gravity") {
      EXPECT_EQ(group.count(), 1u);
    }
    if (group.law.name == "drag" || group.law.name == "uniform_field") {
      EXPECT_EQ(group.count(), 2u);
    }
  }
  EXPECT_EQ(s.shape.obstacles, 43);
  EXPECT_TRUE(s.shape.fixed.empty());
}

TEST(Obstacles, ThrowBackWhatHitsThem) {
  const RunResult result = run_scene(scene(
      3, R"({"position": [[0.1, 0.2, 1]], "velocity": [[0, 0, -2]]})", barrier(R"("points": [0])"),
      R"("obstacles": [{"position": [[-1, -1, 0], [1, -1, 0], [0, 2, 0]], "triangles": [[0, 1, 2]]}])"));
  EXPECT_EQ(result.summary.outcome, Outcome::success);
  EXPECT_NEAR(result.summary.velocity(0, 2), 2, 1e-8);  // to the tolerance of 1e-9 m a step
  EXPECT_LT(result.summary.max_relative_energy_error, 1e-8);
}

TEST(Obstacles, MayBeASphere) {
  const Mesh sphere = geodesic_sphere(2, 3);
  EXPECT_EQ(sphere.triangles.size(), 20u * 9);
  EXPECT_EQ(sphere.position.rows(), 10 * 9 + 2);  // Euler: V = 2 + E - F, E = 3 F / 2
  for (const auto& x : sphere.position.rowwise()) EXPECT_NEAR(x.norm(), 2, 1e-15 * 4);
  double volume = 0;
  for (const auto& [a, b, c] : sphere.triangles) {
    const Eigen::Vector3d x = sphere.position.row(a), y = sphere.position.row(b), z = sphere.position.row(c);
    EXPECT_GT(x.dot(y.cross(z)), 0);  // turns left when seen from outside
    volume += x.dot(y.cross(z)) / 6;
  }
  // Less than that of the sphere by some (edge / radius)^2 / 4 of it, the edges being 0.4 of the radius or less.
  EXPECT_NEAR(volume / (4.0 / 3 * std::acos(-1) * 8), 0.95, 0.02);
  std::map<std::array<int, 2>, int> passed;
  for (const auto& [a, b, c] : sphere.triangles)
    for (const auto& edge : {std::array{a, b}, {b, c}, {c, a}}) ++passed[edge];
  EXPECT_THAT(passed, Each(Pair(::testing::_, 1)));  // closed: every edge once in each direction
}

TEST(Obstacles, MayBeAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "wall.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 2 0\nf 1 2 3\n";
  const Scene s = read_scene(
      contact_scenes::text(3, ball, barrier(R"("points": [0])"), R"("obstacles": [{"mesh": "wall.obj"}])"),
      "test", folder.path());
  EXPECT_EQ(s.system->particles(), 4);
  const RunResult result = run_scene(s);
  EXPECT_EQ(result.summary.outcome, Outcome::success);
}

TEST(Obstacles, AreKeptInTheSceneThatIsShown) {
  const std::string more = R"("obstacles": [{"sphere": {"radius": 1}}])";
  const Scene s = scene(3, ball, barrier(R"("surface": "points")"), more);
  EXPECT_EQ(read_scene(s.json, "again", ".").json, s.json);
  EXPECT_EQ(nlohmann::json::parse(s.json)["obstacles"][0]["sphere"]["cells"], 4);
}

}  // namespace
}  // namespace jetlag::testing::surfaces_in_scenes_test
