// SPDX-License-Identifier: MIT
// Every bad scene gives exit code 2 and a message that names the key, the value and what is allowed; nothing is
// written.
#include "scenes/bad_scenes.hpp"

#include <gtest/gtest.h>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

TEST(GoodScene, Runs) {
  const TemporaryFolder folder;
  write(folder / "scene.json", good);
  const Ended run = program("run scene.json --out out --quiet", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/summary.json"));
}

TEST_P(BadSceneTest, IsRefusedWithItsKeyNamedAndNothingWritten) {
  const BadScene& bad = GetParam();
  const TemporaryFolder folder;
  write(folder / "scene.json", text_of(bad));
  for (const char* command : {"run scene.json --out out", "check scene.json"}) {
    const Ended run = program(command, folder.path());
    EXPECT_EQ(run.exit_code, 2) << command << ": " << run.output;
    EXPECT_NE(run.output.find(bad.key), std::string::npos) << "no '" << bad.key << "' in: " << run.output;
    EXPECT_NE(run.output.find(bad.says), std::string::npos) << "no '" << bad.says << "' in: " << run.output;
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 1) << "something was written";  // the scene itself
}

// What a name must be unique for: the part before the test's number in the list.
const BadScene bad_scenes[] = {
    {"EmptyFile", "", " ", "scene.json", "not well-formed"},
    {"TruncatedFile", "", R"({"name": "x", "forces": [{"type": "spring", "stiff)", "forces[0].type",
     "not well-formed"},
    {"NotAnObject", "", "[1, 2]", "scene", "must be a JSON object"},
    {"NaN", "", R"({"particles": {"position": [[0.0], [NaN]]}})", "particles.position[1]", "not well-formed"},
    {"NumberBeyondDouble", "", R"({"control": {"step": 1e999}})", "control.step", "range of double"},
    {"KeyTwice", "", R"({"until": 1, "until": 2})", "until", "twice"},
    {"NestedTooDeep", "", R"({"a": )" + std::string(100, '[') + std::string(100, ']') + "}", "a",
     "nested deeper"},
    {"UnknownKey", "/untill", "3", "untill", "unknown key"},
    {"UnknownKeyOfForce", "/forces/0/stifness", "3", "forces[0].stifness",
     "allowed here: type, pairs, stiffness"},
    {"UnknownKeyOfOutput", "/output/frame", "3", "output.frame", "frames"},
    {"MissingUntil", "/until", "", "until", "is missing"},
    {"MissingIntegrator", "/integrator", "", "integrator", "is missing"},
    {"MissingStiffness", "/forces/0/stiffness", "", "forces[0].stiffness", "is missing"},
    {"MissingPosition", "/particles/position", "", "particles.position", "is missing"},
    {"UntilZero", "/until", "0", "until", "> 0"},
    {"UntilText", "/until", "\"later\"", "until", "later"},
    {"DimensionFour", "/dimension", "4", "dimension", "from 1 to 3"},
    {"DimensionOfPositions", "/dimension", "3", "particles.position[0]", "array of 3 numbers"},
    {"PositionOfText", "/particles/position/1/0", "\"a\"", "particles.position[1][0]", "a finite number"},
    {"NoParticles", "/particles/position", "[]", "particles.position", "at least one"},
    {"NegativeMass", "/particles/mass", "[1, -2, 3]", "particles.mass[1]", "got -2; must be a number > 0"},
    {"ZeroMass", "/particles/mass", "0", "particles.mass", "> 0"},
    {"TooFewMasses", "/particles/mass", "[1, 2]", "particles.mass", "one for each particle"},
    {"FixedParticleThatDoesNotExist", "/particles/fixed", "[3]", "particles.fixed[0]", "from 0 to 2"},
    {"FixedParticleThatMoves", "/particles/velocity/0/0", "1", "particles.velocity[0]", "fixed"},
    {"TooFewVelocities", "/particles/velocity", "[[0, 0], [1, 1]]", "particles.velocity", "as many"},
    {"UnknownForce", "/forces/0/type", "\"sprong\"", "forces[0].type",
     "spring, drag, uniform_field, oscillating_field, gravity, floor, neo_hookean, stable_neo_hookean, stvk, "
     "corotated, "
     "traction, pressure, membrane, bending, angle, dihedral or contact_barrier"},
    {"ForceWithoutType", "/forces/1/type", "", "forces[1].type", "is missing"},
    {"ForcesNotAnArray", "/forces", "{}", "forces", "an array"},
    {"PairOutOfRange", "/forces/0/pairs", "[[0, 1], [1, 7]]", "forces[0].pairs[1][1]", "got 7"},
    {"PairWithItself", "/forces/0/pairs", "[[0, 1], [2, 2]]", "forces[0].pairs[1]", "two different"},
    {"PairOfThree", "/forces/0/pairs", "[[0, 1, 2], [1, 2]]", "forces[0].pairs[0]", "two particles"},
    {"PairIndexNotWhole", "/forces/0/pairs", "[[0, 1.5], [1, 2]]", "forces[0].pairs[0][1]", "a whole number"},
    {"EdgesWithoutMesh", "/forces/0/pairs", "\"edges\"", "forces[0].pairs", "no mesh"},
    {"NegativeStiffness", "/forces/0/stiffness", "[5, -6]", "forces[0].stiffness[1]", "got -6"},
    {"TooManyStiffnesses", "/forces/0/stiffness", "[5, 6, 7]", "forces[0].stiffness", "one for each spring"},
    {"NegativeRestLength", "/forces/0/rest_length", "-1", "forces[0].rest_length", ">= 0"},
    {"NegativeSoftening", "/forces/3/softening", "-1", "forces[3].softening", ">= 0"},
    {"SofteningWhosePowersAreNone", "/forces/3/softening", "1e-110", "forces[3].softening", "from 1e-100"},
    {"FloorOfPowerThree", "/forces/1", R"({"type": "floor", "stiffness": 1, "power": 3})", "forces[1].power",
     "1 to 2"},
    {"FloorWithoutNormal", "/forces/1", R"({"type": "floor", "stiffness": 1, "normal": [0, 0]})",
     "forces[1].normal", "not all 0"},
    {"NegativeDrag", "/forces/1/coefficient", "-1", "forces[1].coefficient", ">= 0"},
    {"FieldOfWrongLength", "/forces/2/acceleration", "[0, 0, -9.8]", "forces[2].acceleration", "array of 2"},
    {"CoincidentParticles", "/particles/position", "[[0, 0], [1, 0], [1, 0]]", "forces[0].pairs[1]",
     "same place"},
    {"ClocksNotABoolean", "/output/clocks", "3", "output.clocks", "true or false"},
    {"GridBeyondDouble", "", R"({"until": 1, "particles": {"grid": [3], "spacing": 1e308},
         "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 1}})",
     "particles.grid", "overflow"},
    {"VelocityBeyondDouble", "",
     R"({"until": 1, "particles": {"grid": [3], "spacing": 1, "velocity": {"normal": 1e308}},
         "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 1}})",
     "particles.velocity", "overflow"},
    {"MoreThanTheMemory", "",
     R"({"until": 1, "particles": {"grid": [5000], "spacing": 1}, "forces": [{"type": "gravity"}],
         "integrator": {"type": "taylor", "degree": 256}, "control": {"type": "fixed", "step": 1}})",
     "particles", "memory"},
    {"SubnormalMass", "/particles/mass", "1e-310", "particles.mass", "from 1e-300"},
    {"NoThreads", "/schedule/threads", "0", "schedule.threads", "1"},
    {"HalfAThread", "/schedule/threads", "1.5", "schedule.threads", "1"},
    {"UnknownSchedule", "/schedule/type", "\"chaos\"", "schedule.type", "lockstep"},
    {"NegativeSeed", "/seed", "-1", "seed", "a whole number"},
    {"SeedNotWhole", "/seed", "1.5", "seed", "a whole number"},
    {"NegativeFrames", "/output/frames", "-1", "output.frames", "from 0"},
    {"HalfAFrame", "/output/frames", "2.5", "output.frames", "got 2.5; must be a whole number"},
    {"DimensionNotWhole", "/dimension", "2.0000000000000004", "dimension", "a whole number"},
    {"SeedBeyondDoubt", "/seed", "9007199254740994.0", "seed", "a whole number"},
    {"EnergyNotBoolean", "/output/energy", "\"yes\"", "output.energy", "true or false"},
    {"MissingMesh", "/particles", R"({"mesh": "nowhere.mesh"})", "particles.mesh", "3"},
    {"HugeGrid", "/particles", R"({"grid": [100000, 1000], "spacing": 1})", "particles.grid", "at most"},
    {"OddCellsAcross", "",
     R"({"until": 1, "particles": {"ellipsoid": {"radii": [1, 1, 1], "cells": [5, 4]}}})",
     "particles.ellipsoid.cells", "even"},
    {"NegativeRadius", "/particles", R"({"ellipse": {"radii": [1, -1]}})", "particles.ellipse.radii[1]",
     "> 0"},
};

INSTANTIATE_TEST_SUITE_P(Scenes, BadSceneTest, ::testing::ValuesIn(bad_scenes),
                         [](const auto& info) { return info.param.name; });

TEST(BadMesh, NamesFileAndLine) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& says) {
    write(folder / "bad.mesh", text);
    const Ended run = program(R"(run body --set particles='{"mesh": "bad.mesh"}' --out out)", folder.path());
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_NE(run.output.find("particles.mesh"), std::string::npos) << run.output;
    EXPECT_NE(run.output.find(says), std::string::npos) << "no '" << says << "' in: " << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  const std::string head = "MeshVersionFormatted 1\nDimension 3\n";
  const std::string points = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  refused("", "line 0");
  refused("OFF\n3 1 0\n", "MeshVersionFormatted");
  refused(head, "no section Vertices");
  refused(head + points, "no Tetrahedra");
  refused(head + "Vertices\n4\n0 0 0 0\n1 0", "line 6");
  refused(head + "Vertices\n1000000000000\n", "number of vertices");
  refused(head + "Vertices\n40000000\n0 0 0 0\n", "the file ends");
  refused(head + "Vertices\n1\n0 nan 0 0\n", "finite");
  refused(head + "Vertices\n1\n0 1e400 0 0\n", "finite");
  refused(head + points + "Tetrahedra\n1\n1 2 3 5 0\n", "from 1 to 4");
  refused(head + points + "Tetrahedra\n1\n1 2 3 3 0\n", "vertex 3 twice");
  refused(head + "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\nTetrahedra\n1\n1 2 3 4 0\n", "no volume");
  refused(head + points + "Surprise\n1\n", "Surprise");
  refused(head + points + "Tetrahedra\n1\n1 2 3 4 0\n5\n", "got '5'; must be a section");
  refused(head + "Vertices\n1\n0 1.5D+400 0 0\n", "finite");
  refused(head + "Vertices\n1\n0 +-1 0 0\n", "finite");
  refused(head + "Vertices\n1.5\n", "number of vertices");
}

TEST(BadCommandLine, ExitsWithTwo) {
  const TemporaryFolder folder;
  for (const char* arguments : {"",
                                "fly",
                                "run",
                                "run nosuchscene",
                                "run body --set",
                                "run body --set control.step",
                                "run body --seed x",
                                "run body --set forces[9].stiffness=1",
                                "run body --set until.x=1",
                                "study nothing",
                                "run body --seed -1",
                                "run body --seed 18446744073709551616",
                                "run body --seed 1.5",
                                "run body --set =1",
                                "run body --set a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1",
                                "run body --set name=$'\\xff'",
                                "run body --set particles.mass[0]=2",
                                "study paper_table --step -1",
                                "study paper_table --until nan",
                                "study paper_table --rows 9",
                                "study paper_table --mesh nowhere.mesh",
                                "study kepler --periods 0",
                                "study brouwer --runs many",
                                "study ruler --seeds 0"}) {
    const Ended run = program(arguments, folder.path());
    EXPECT_EQ(run.exit_code, 2) << arguments << ": " << run.output;
    EXPECT_FALSE(run.output.empty());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(BadScene, LeavesAnEarlierRunAlone) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("run chain --out out --set until=0.1 --quiet", folder.path()).exit_code, 0);
  const std::string before = content(folder / "out/summary.json");
  EXPECT_EQ(program("run chain --out out --set control.step=0", folder.path()).exit_code, 2);
  EXPECT_EQ(content(folder / "out/summary.json"), before);
}

TEST(Output, ThatCannotBeWrittenIsAnError) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const TemporaryFolder folder;
  EXPECT_EQ(program("show body > /dev/full", folder.path()).exit_code, 1);
}

TEST(BadInstructionSet, IsNamed) {
  const TemporaryFolder folder;
  setenv("JETLAG_INSTRUCTION_SET", "mmx", 1);
  const Ended run = program("run chain --out out", folder.path());
  unsetenv("JETLAG_INSTRUCTION_SET");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.output.find("JETLAG_INSTRUCTION_SET"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("mmx"), std::string::npos) << run.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace jetlag::testing
