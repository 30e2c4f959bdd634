// SPDX-License-Identifier: MIT
// Cloth in scenes: its elements are those that the library makes of the same numbers, and what cannot be is refused.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/model/hinges.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing::cloth_in_scenes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene scene(const std::string& particles, const std::string& forces, int dimension = 3) {
  return read_scene(R"({"dimension": )" + std::to_string(dimension) + R"(, "particles": {)" + particles +
                        R"(}, "forces": [)" + forces +
                        R"(], "integrator": {"type": "taylor", "degree": 4},
                            "control": {"type": "fixed", "step": 1e-3}, "until": 0.01})",
                    "test", ".");
}

const std::string sheet_of_6_by_4 = R"("sheet": {"lengths": [3, 2], "cells": [6, 4]})";
const std::string membrane = R"({"type": "membrane", "young": 1e5, "poisson": 0.3, "thickness": 0.01})";

template <ForceLaw L>
void expect_elements(const Elements<double>& found, const Coordinates<double>& rest,
                     const std::vector<std::array<int, L::participants>>& elements,
                     const std::array<double, L::material.size()>& material) {
  System<> by_hand(3, std::vector<double>(rest.rows(), 1.0));
  by_hand.add_at_rest<L>(elements, rest, {material});
  EXPECT_EQ(found.law.name, L::name);
  EXPECT_EQ(found.particles, by_hand.elements()[0].particles);
  EXPECT_EQ(found.parameters, by_hand.elements()[0].parameters);
}

TEST(ClothInScenes, IsThatOfTheLibrary) {
  const Scene read =
      scene(sheet_of_6_by_4 + R"(, "density": 1000, "thickness": 0.01)",
            R"({"type": "membrane", "young": 1e5, "poisson": 0.3, "thickness": 0.01, "damping_time": 0.5},
                              {"type": "bending"}, {"type": "bending", "rigidity": 2})");
  const Mesh mesh = sheet({3, 2}, {6, 4}, SheetPattern::equilateral);
  EXPECT_EQ(read.initial.position, mesh.position);
  EXPECT_EQ(read.shape.surface, mesh.triangles);
  EXPECT_EQ(read.system->mass(), lumped_masses(mesh.position, mesh.triangles, 1000.0, 0.01));
  const Lame<double> thin = plane_stress(lame(1e5, 0.3));
  ASSERT_EQ(read.system->elements().size(), 4u);
  const auto& found = read.system->elements();
  expect_elements<Membrane>(found[0], mesh.position, mesh.triangles, {thin.lambda, thin.mu, 0.01});
  const Lame<double> viscous =
      plane_stress(Lame<double>{0.5 * lame(1e5, 0.3).lambda, 0.5 * lame(1e5, 0.3).mu});
  expect_elements<MembraneKelvinVoigt>(found[1], mesh.position, mesh.triangles,
                                       {viscous.lambda, viscous.mu, 0.01});
  expect_elements<Bending>(found[3], mesh.position, hinges_of(mesh.triangles), {2.0});
  // D = E t^3 / (12 (1 - nu^2)) = 1e5 * 1e-6 / 10.92; E and nu come back from Lame's constants: some roundings.
  const double share = found[2].parameters[0] / found[3].parameters[0];
  EXPECT_NEAR(share * share, 0.1 / 10.92 / 2, 1e-14);
}

TEST(ClothInScenes, IsCutAsAsked) {
  for (const auto& [name, pattern] : {std::pair{"equilateral", SheetPattern::equilateral},
                                      {"crisscross", SheetPattern::crisscross},
                                      {"uniform", SheetPattern::uniform}}) {
    const Scene read =
        scene(R"("sheet": {"lengths": [3, 2], "cells": [6, 4], "corner": [0, 0, 5], "pattern": ")" +
                  std::string(name) + R"("})",
              membrane);
    Mesh mesh = sheet({3, 2}, {6, 4}, pattern);
    mesh.position.col(2).array() += 5;
    EXPECT_EQ(read.initial.position, mesh.position);
    EXPECT_EQ(read.shape.surface, mesh.triangles);
  }
}

TEST(ClothInScenes, KeepsItsFoldsOrWantsToBeFlat) {
  const std::string roof =
      R"("position": [[0, 0, 0], [1, 0, 0], [0.2, 0.9, 0.3], [0.3, -0.8, 0.4]], "triangles": [[0, 1, 2], [1, 0, 3]])";
  Coordinates<double> rest(4, 3);
  rest << 0, 0, 0, 1, 0, 0, 0.2, 0.9, 0.3, 0.3, -0.8, 0.4;
  for (const double share : {1.0, 0.0}) {
    const Scene read = scene(roof, R"({"type": "bending", "model": "hinge", "rigidity": 2, "rest_angle": )" +
                                       std::string(share == 1 ? R"("initial")" : "0") + "}");
    expect_elements<Hinge>(read.system->elements()[0], rest, {{0, 1, 2, 3}}, {2.0, share});
  }
}

TEST(GustsInScenes, SwingWithTheirFrequency) {
  const Scene read =
      scene(R"("position": [[0, 0, 0]])",
            R"({"type": "oscillating_field", "acceleration": [1, 2, 3], "frequency": 0.5, "phase": 0.25})");
  EXPECT_EQ(read.system->elements()[0].parameters, (std::vector<double>{1, 2, 3, std::numbers::pi, 0.25}));
}

struct Refused {
  const char* name;
  std::string particles, force;
  const char *key, *says;
  int dimension = 3;
};
void PrintTo(const Refused& scene, std::ostream* out) { *out << scene.name; }

class RefusedCloth : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedCloth, NamesKeyAndReason) {
  const Refused& p = GetParam();
  EXPECT_THAT([&] { scene(p.particles, p.force, p.dimension); },
              ThrowsMessage<SceneError>(AllOf(HasSubstr(p.key), HasSubstr(p.says))));
}

const std::string points =
    R"("position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 1], [1, 1, 0], [2, 0, 0]], "triangles": )";
const std::string bending = R"({"type": "bending", "rigidity": 1})";

INSTANTIATE_TEST_SUITE_P(
    Scenes, RefusedCloth,
    ::testing::Values(
        Refused{"InThePlane", R"("box": {"lengths": [1, 1], "cells": [1, 1]})", membrane, "dimension",
                "in the plane take stvk", 2},
        Refused{"NoTriangles", R"("position": [[0, 0, 0]])", membrane, "forces[0].elements",
                "a list of triangles"},
        Refused{"FlatTriangle", points + "[[0, 1, 5]]", membrane, "forces[0].elements, number 0",
                "flat at rest"},
        Refused{"NoThickness", sheet_of_6_by_4, R"({"type": "membrane", "young": 1, "poisson": 0.3})",
                "forces[0].thickness", "missing"},
        Refused{"EdgeOfThree", points + "[[0, 1, 2], [1, 0, 3], [0, 1, 4]]", bending, "forces[0].elements",
                "edge 0-1 belongs to triangles 0, 1, 2"},
        Refused{"Orientation", points + "[[0, 1, 2], [0, 1, 3]]", bending, "forces[0].elements",
                "disagree in orientation"},
        Refused{"Folded", points + "[[0, 1, 2], [1, 0, 3]]", bending, "forces[0].elements, edge 0-1",
                "take hinge"},
        Refused{"Rigidity", sheet_of_6_by_4, R"({"type": "bending", "rigidity": -1})", "forces[0].rigidity",
                ">= 0"},
        Refused{"NoMembrane", sheet_of_6_by_4, R"({"type": "bending"})", "forces[0].rigidity", "no membrane"},
        Refused{
            "MembraneOfTwo", sheet_of_6_by_4,
            membrane +
                R"(, {"type": "membrane", "elements": {"inside": [[0, 0, 0], [0.5, 0.5, 0]]}, "thickness": 1,
                                 "young": [1, 2], "poisson": 0.3}, {"type": "bending"})",
            "forces[2].rigidity", "no membrane"},
        Refused{"NoInnerEdge", points + "[[0, 1, 2]]", bending, "forces[0].elements",
                "an edge between two triangles"},
        Refused{
            "BeginsFolded",
            R"("position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]], "rest": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0]],
                   "triangles": [[0, 1, 2], [1, 0, 3]])",
            R"({"type": "bending", "model": "hinge", "rigidity": 1})", "forces[0].elements, edge 0-1",
            "full fold"},
        Refused{"AngleOfAFlatModel", sheet_of_6_by_4,
                R"({"type": "bending", "rigidity": 1, "rest_angle": 0})", "forces[0].rest_angle",
                "quadratic"},
        Refused{"Angle", sheet_of_6_by_4,
                R"({"type": "bending", "model": "hinge", "rigidity": 1, "rest_angle": 1})",
                "forces[0].rest_angle", "\"initial\" or 0"},
        Refused{"Pattern", R"("sheet": {"lengths": [1, 1], "cells": [1, 1], "pattern": "herringbone"})",
                membrane, "particles.sheet.pattern", "equilateral, crisscross or uniform"},
        Refused{"SheetInThePlane", R"("sheet": {"lengths": [1, 1], "cells": [1, 1]})", membrane, "dimension",
                "must be 3", 2},
        Refused{"DensityWithoutThickness", sheet_of_6_by_4 + R"(, "density": 1)", membrane,
                "particles.thickness", "missing"},
        Refused{"Frequency", R"("position": [[0, 0, 0]])",
                R"({"type": "oscillating_field", "acceleration": [0, 0, 1], "frequency": 0})",
                "forces[0].frequency", "> 0"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace jetlag::testing::cloth_in_scenes_test
