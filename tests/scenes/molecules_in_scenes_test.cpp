// SPDX-License-Identifier: MIT
// Angles and torsion in scenes.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing::molecules_in_scenes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene scene(const std::string& positions, const std::string& force, int dimension = 3) {
  return read_scene(R"({"dimension": )" + std::to_string(dimension) + R"(, "particles": {"position": )" +
                        positions + R"(}, "forces": [)" + force +
                        R"(], "integrator": {"type": "taylor", "degree": 8},
                            "control": {"type": "fixed", "step": 1e-3}, "until": 0.01})",
                    "test", ".");
}
double energy_of(const Scene& scene) { return EnergyMeter(*scene.system)(scene.initial).total(); }

const std::string right_angle = "[[1, 0, 0], [0, 0, 0], [0, 2, 0]]";

TEST(AnglesInScenes, HaveTheEnergyOfTheirCosine) {  // k/2 (cos phi - cos phi_0)^2
  const std::string begin = R"({"type": "angle", "elements": [[0, 1, 2]], "stiffness": 3)";
  EXPECT_EQ(energy_of(scene(right_angle, begin + "}")), 0);
  EXPECT_NEAR(energy_of(scene(right_angle, begin + R"(, "angle": 1.0})")), 1.5 * std::pow(std::cos(1.0), 2),
              1e-15);
  EXPECT_NEAR(energy_of(scene("[[1, 0], [0, 0], [0, 2]]", begin + R"(, "angle": [1.0]})", 2)),
              1.5 * std::pow(std::cos(1.0), 2), 1e-15);
  EXPECT_EQ(scene(right_angle, begin + "}").shape.lines.size(), 2u);
}

TEST(TorsionInScenes, HasTheEnergyOfItsAngle) {  // cis, and a quarter turn from it
  const std::string quarter = "[[0, 1, 0], [0, 0, 0], [1, 0, 0], [1, 0, 1]]";
  const auto torsion = [](int n, const char* phase) {
    return R"({"type": "dihedral", "elements": [[0, 1, 2, 3]], "stiffness": 3, "multiplicity": )" +
           std::to_string(n) + R"(, "phase": )" + phase + "}";
  };
  const double quarter_turn = std::numbers::pi / 2;
  for (int n = 1; n <= 3; ++n) {
    EXPECT_NEAR(energy_of(scene("[[0, 1, 0], [0, 0, 0], [1, 0, 0], [1, 1, 0]]", torsion(n, "0.5"))),
                3 * (1 + std::cos(0.5)), 1e-14);
    EXPECT_NEAR(energy_of(scene(quarter, torsion(n, "0"))), 3 * (1 + std::cos(n * quarter_turn)), 1e-14);
  }
}

TEST(MolecularForces, RefuseWhatHasNoAngle) {
  const auto refused = [](const std::string& force, const std::string& key, const std::string& says,
                          int dimension = 3, const std::string& positions = right_angle) {
    EXPECT_THAT(([&] { scene(positions, force, dimension); }),
                ThrowsMessage<SceneError>(AllOf(HasSubstr(key), HasSubstr(says))));
  };
  refused(R"({"type": "angle", "stiffness": 1})", "forces[0].elements", "missing");
  refused(R"({"type": "angle", "elements": [[0, 1]], "stiffness": 1})", "forces[0].elements[0]",
          "three particles");
  refused(R"({"type": "angle", "elements": [[0, 1, 2]], "stiffness": -1})", "forces[0].stiffness", ">= 0");
  refused(R"({"type": "angle", "elements": [[0, 1, 2]], "stiffness": 1, "angle": 4})", "forces[0].angle",
          "0 to pi");
  refused(R"({"type": "angle", "elements": [[0, 1, 2]], "stiffness": 1})", "forces[0].elements[0]",
          "different places", 3, "[[0, 0, 0], [0, 0, 0], [1, 1, 1]]");
  refused(R"({"type": "dihedral", "elements": [[0, 1, 2, 3]], "stiffness": 1})", "forces[0].elements[0]",
          "not in line", 3, "[[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0]]");
  refused(R"({"type": "dihedral", "elements": [[0, 1, 2, 3]], "stiffness": 1, "multiplicity": 4})",
          "forces[0].multiplicity", "1 to 3", 3, "[[0, 1, 0], [0, 0, 0], [1, 0, 0], [1, 0, 1]]");
  refused(R"({"type": "dihedral", "elements": [[0, 1, 2, 3]], "stiffness": 1})", "dimension: got 2",
          "must be 3 for forces[0]", 2, "[[0, 1], [0, 0], [1, 0], [1, 1]]");
}

}  // namespace
}  // namespace jetlag::testing::molecules_in_scenes_test
