// SPDX-License-Identifier: MIT
// Contacts in scenes that cannot be: refused with the key, the value and what is allowed; and what is warned of.
#include <gmock/gmock.h>

#include "jetlag/scenes/error.hpp"
#include "scenes/contact/contact_scenes.hpp"

namespace jetlag::testing::refused_contacts_test {
namespace {

using contact_scenes::barrier, contact_scenes::scene;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// Of a cube of 1 m whose lowest corner is the origin.
struct Refused {
  const char *name, *force, *begins, *says, *more = "";
};
void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

constexpr const char* cube = R"({"box": {"lengths": [1, 1, 1], "cells": [1, 1, 1]}, "mass": 1})";
constexpr const char* line_of_three = R"({"position": [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]})";
constexpr const char* given = R"({"type": "contact_barrier", "thickness": 0.1, "stiffness": 1000})";

class RefusedContact : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedContact, NamesKeyValueAndWhatIsAllowed) {
  const auto& [name, force, begins, says, more] = GetParam();
  EXPECT_THAT(([&] { scene(3, cube, force, more); }),
              ThrowsMessage<SceneError>(AllOf(StartsWith(begins), HasSubstr(says))));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, RefusedContact,
    ::testing::Values(
        Refused{"NoThickness", R"({"type": "contact_barrier", "stiffness": 1})", "forces[0].thickness",
                "missing"},
        Refused{"ThicknessZero", R"({"type": "contact_barrier", "thickness": 0, "stiffness": 1})",
                "forces[0].thickness: got 0", "> 0"},
        Refused{"ThicknessWhoseSquareOverflows",
                R"({"type": "contact_barrier", "thickness": 1e200, "stiffness": 1})",
                "forces[0].thickness: got 1e+200", "up to 1e150"},
        Refused{"StiffnessNegative", R"({"type": "contact_barrier", "thickness": 1, "stiffness": -2})",
                "forces[0].stiffness: got -2", "> 0"},
        Refused{"GapNegative", R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "gap": -1})",
                "forces[0].gap: got -1", ">= 0"},
        Refused{"PowerTooLarge", R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "power": 8})",
                "forces[0].power: got 8", "from 1 to 7"},
        Refused{"SelfANumber", R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "self": 1})",
                "forces[0].self: got 1", "true or false"},
        Refused{"UnknownSurface",
                R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "surface": "hull"})",
                "forces[0].surface: got \"hull\"", "boundary or points"},
        Refused{
            "SurfaceBesideLists",
            R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "surface": "points", "points": [1]})",
            "forces[0].surface: got \"points\"", "left out beside triangles, edges or points"},
        Refused{
            "TriangleOutOfRange",
            R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "triangles": [[0, 1, 2], [0, 1, 8]]})",
            "forces[0].triangles[1][2]: got 8", "from 0 to 7"},
        Refused{"TriangleWithAVertexTwice",
                R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "triangles": [[0, 1, 1]]})",
                "forces[0].triangles[0]: got [0,1,1]", "three different particles"},
        Refused{"EdgeWithAVertexTwice",
                R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "edges": [[0, 1], [3, 3]]})",
                "forces[0].edges[1]: got [3,3]", "two different particles"},
        Refused{
            "TriangleTwice",
            R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "triangles": [[0, 1, 2], [2, 1, 0]]})",
            "forces[0].triangles[1]", "the same particles as of number 0"},
        Refused{"PointTwice",
                R"({"type": "contact_barrier", "thickness": 1, "stiffness": 1, "points": [3, 3]})",
                "forces[0].points[1]: got 3", "not listed yet"},
        Refused{"Avi", given, "integrator.type: got \"avi\"", "with avi take contact_layers",
                R"("integrator": {"type": "avi"}, "control": {"step": 1e-3})"},
        Refused{"Leapfrog", given, "integrator.type: got \"leapfrog\"", "taylor or random_taylor",
                R"("integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 1e-3})"},
        Refused{
            "DrawsOfParticles", given, "integrator.shared_draw: got false", "true",
            R"("integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4, "shared_draw": false},
                   "control": {"type": "fixed", "step": 1e-3})"},
        Refused{"ObstacleOfNothing", given, "obstacles[0]: got {\"cube\":1}", "mesh, sphere, or position",
                R"("obstacles": [{"cube": 1}])"},
        Refused{"ObstaclesNoList", given, "obstacles: got 3", "a list of objects", R"("obstacles": 3)"},
        Refused{"UnknownKeyOfASphere", given, "obstacles[0].sphere.centre", "center, radius or cells",
                R"("obstacles": [{"sphere": {"radius": 1, "centre": [0, 0, 0]}}])"},
        Refused{"SphereWithoutRadius", given, "obstacles[0].sphere.radius", "missing",
                R"("obstacles": [{"sphere": {}}])"},
        Refused{
            "FlatTriangleOfAnObstacle", given, "obstacles[0].triangles[0]", "has no area",
            R"("obstacles": [{"position": [[5, 0, 0], [6, 0, 0], [7, 0, 0]], "triangles": [[0, 1, 2]]}])"},
        Refused{
            "IndexOfAnObstacle", given, "obstacles[0].triangles[0][2]: got 3", "from 0 to 2",
            R"("obstacles": [{"position": [[5, 0, 0], [6, 0, 0], [7, 0, 0]], "triangles": [[0, 1, 3]]}])"},
        Refused{
            "NearerThanTheGap",
            R"({"type": "contact_barrier", "thickness": 1e-2, "stiffness": 1, "gap": 0.05, "triangles": [[1, 3, 5]]})",
            "forces[0]: vertex 8 and triangle (1, 3, 5) are 0.04",
            "no more than the gap 0.05 m: move them apart",
            R"("obstacles": [{"position": [[0.3, 0.3, 1.04]]}])"},
        Refused{"OnTheSurface", given, "forces[0]: vertex 8 and triangle (1, 5, 7) are 0 m apart",
                "no more than the gap 0 m", R"("obstacles": [{"position": [[0.75, 0.5, 1]]}])"},
        Refused{"EdgeThroughATriangle", given,
                "forces[0]: edge (8, 9) passes through triangle (1, 5, 7) at (0.75, 0.5, 1)",
                "move them apart",
                R"("obstacles": [{"position": [[0.75, 0.5, 0.5], [0.75, 0.5, 2]], "edges": [[0, 1]]}])"}),
    [](const auto& p) { return p.param.name; });

TEST(RefusedContacts, NameFlatTriangles) {
  EXPECT_THAT(([&] { scene(3, line_of_three, barrier(R"("triangles": [[0, 1, 3], [0, 1, 2]])")); }),
              ThrowsMessage<SceneError>(StartsWith("forces[0].triangles[1]: has no area")));
}

TEST(RefusedContacts, TellThatTrianglesNeedSpace) {
  EXPECT_THAT(([&] {
                scene(2, R"({"position": [[0, 0], [1, 0], [0, 1]]})", barrier(R"("triangles": [[0, 1, 2]])"));
              }),
              ThrowsMessage<SceneError>(
                  AllOf(HasSubstr("forces[0].triangles"), HasSubstr("in the plane take edges"))));
}

TEST(RefusedContacts, TellThatThereIsNoBoundary) {
  EXPECT_THAT(([&] { scene(3, line_of_three, barrier()); }),
              ThrowsMessage<SceneError>(AllOf(StartsWith("forces[0].surface"), HasSubstr("\"points\""))));
}

TEST(RefusedContacts, NameEdgesThatCrossInThePlane) {
  EXPECT_THAT(([&] {
                scene(2, R"({"position": [[0, 0], [2, 2], [0, 2], [2, 0]]})",
                      barrier(R"("edges": [[0, 1], [2, 3]])"));
              }),
              ThrowsMessage<SceneError>(
                  "forces[0]: edge (0, 1) passes through edge (2, 3) at (1, 1): move them apart"));
}

TEST(RefusedContacts, AllowEdgesOfOneBodyToCrossWhereItDoesNotTouchItself) {
  const std::string bent = R"({"position": [[0, 0], [2, 2], [0, 2], [2, 0]]})";
  EXPECT_NO_THROW(scene(2, bent, barrier(R"("edges": [[0, 1], [1, 2], [2, 3]], "self": false)")));
  EXPECT_ANY_THROW(scene(2, bent, barrier(R"("edges": [[0, 1], [1, 2], [2, 3]])")));
}

TEST(RefusedContacts, WarnOfNeighboursAtRestWithinTheThickness) {
  // Cells of 0.1 m, cut: 0.1 / sqrt(2) m is from a corner to the diagonal across, the nearest without a common vertex.
  const std::string net = R"({"grid": [3, 3], "spacing": 0.1, "mass": 1})";
  const auto warnings = [&](const std::string& force) { return scene(3, net, force).warnings; };
  EXPECT_THAT(warnings(barrier()),
              ElementsAre(AllOf(
                  StartsWith("forces[0].thickness: vertex 1 and triangle (0, 3, 4) of one body are 0.070710"),
                  HasSubstr("a thickness up to 0.07071067812 m leaves them alone"))));
}

TEST(RefusedContacts, DoNotWarnOfBodiesThatDoNotTouchThemselvesOrAreWide) {
  const std::string net = R"({"grid": [3, 3], "spacing": 0.1, "mass": 1})";
  EXPECT_THAT(scene(3, net, barrier(R"("self": false)")).warnings, IsEmpty());
  EXPECT_THAT(scene(3, R"({"grid": [3, 3], "spacing": 0.2, "mass": 1})", barrier()).warnings, IsEmpty());
}

}  // namespace
}  // namespace jetlag::testing::refused_contacts_test
