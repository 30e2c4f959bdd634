// SPDX-License-Identifier: MIT
// Every bad scene gives exit code 2 and a message that names the key, the value and what is allowed; nothing is
// written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

const char* const good = R"({
  "name": "good", "dimension": 2,
  "particles": {"position": [[0, 0], [1, 0], [1, 1]], "velocity": [[0, 0], [0, 1], [0, 0]], "mass": [1, 2, 3], "fixed": [0]},
  "forces": [
    {"type": "spring", "pairs": [[0, 1], [1, 2]], "stiffness": [5, 6], "rest_length": 1.0},
    {"type": "drag", "coefficient": 0.2},
    {"type": "uniform_field", "acceleration": [0, -9.8]},
    {"type": "gravity", "constant": 1.0}
  ],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.5},
  "control": {"type": "fixed", "step": 0.01},
  "schedule": {"type": "lockstep"},
  "until": 0.1, "seed": 1, "output": {"frames": 2, "energy": true, "pictures": false}
})";

TEST(GoodScene, Runs) {
  const TemporaryFolder folder;
  write(folder / "scene.json", good);
  const Ended run = program("run scene.json --out out --quiet", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/summary.json"));
}

struct BadScene {
  std::string name;
  std::string pointer;  // JSON pointer of what is replaced; "" with text: the whole file
  std::string value;    // JSON; "" removes
  std::string key;      // must be named in the message
  std::string says;     // must be in the message too: the value, or what is allowed
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

std::string text_of(const BadScene& scene) {
  if (scene.pointer.empty()) return scene.value;
  auto json = nlohmann::ordered_json::parse(good);
  const nlohmann::ordered_json::json_pointer at(scene.pointer);
  if (scene.value.empty())
    json[at.parent_pointer()].erase(at.back());
  else
    json[at] = nlohmann::ordered_json::parse(scene.value);
  return json.dump();
}

class BadSceneTest : public ::testing::TestWithParam<BadScene> {};

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

/// Three masses on springs of stiffness 100, 1 and 1 to a wall, moved by a method.
std::string springs_with(const std::string& integrator, const std::string& control = R"("step": 0.01)") {
  return R"({"until": 1, "dimension": 1, "particles": {"position": [[0], [1], [2], [3]], "fixed": [0]},
    "forces": [{"type": "spring", "pairs": [[0, 1], [1, 2], [2, 3]], "stiffness": [100, 1, 1], "rest_length": 1}],
    "integrator": {)" +
         integrator + R"(}, "control": {"type": "fixed", )" + control + "}}";
}
std::string subcycling_with(const std::string& keys, const std::string& control = R"("step": 0.01)") {
  return springs_with(R"("type": "subcycling", )" + keys, control);
}
std::string partition(const std::string& implicit) {
  return springs_with(R"("type": "explicit_implicit", "implicit": )" + implicit);
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
     "spring, drag, uniform_field, gravity or floor"},
    {"ForceWithoutType", "/forces/1/type", "", "forces[1].type", "is missing"},
    {"ForcesNotAnArray", "/forces", "{}", "forces", "an array"},
    {"PairOutOfRange", "/forces/0/pairs", "[[0, 1], [1, 7]]", "forces[0].pairs[1][1]", "got 7"},
    {"PairWithItself", "/forces/0/pairs", "[[0, 1], [2, 2]]", "forces[0].pairs[1]", "two different"},
    {"PairOfThree", "/forces/0/pairs", "[[0, 1, 2], [1, 2]]", "forces[0].pairs[0]", "two particles"},
    {"PairIndexNotWhole", "/forces/0/pairs", "[[0, 1.5], [1, 2]]", "forces[0].pairs[0][1]", "a whole number"},
    {"EdgesWithoutMesh", "/forces/0/pairs", "\"edges\"", "forces[0].pairs", "no mesh"},
    {"NegativeStiffness", "/forces/0/stiffness", "[5, -6]", "forces[0].stiffness[1]", "got -6"},
    {"TooManyStiffnesses", "/forces/0/stiffness", "[5, 6, 7]", "forces[0].stiffness", "one for each spring"},
    {"ZeroRestLength", "/forces/0/rest_length", "0", "forces[0].rest_length", "> 0"},
    {"FloorOfPowerThree", "/forces/1", R"({"type": "floor", "stiffness": 1, "power": 3})", "forces[1].power",
     "1 to 2"},
    {"FloorWithoutNormal", "/forces/1", R"({"type": "floor", "stiffness": 1, "normal": [0, 0]})",
     "forces[1].normal", "not all 0"},
    {"NegativeDrag", "/forces/1/coefficient", "-1", "forces[1].coefficient", ">= 0"},
    {"FieldOfWrongLength", "/forces/2/acceleration", "[0, 0, -9.8]", "forces[2].acceleration", "array of 2"},
    {"CoincidentParticles", "/particles/position", "[[0, 0], [1, 0], [1, 0]]", "forces[0].pairs[1]",
     "same place"},
    {"AviWithDrag", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "drag", "coefficient": 1}], "integrator": {"type": "avi"},
         "control": {"type": "fixed", "step": 1}})",
     "integrator.type", "drag is none: its force depends on velocities"},
    {"AviWithKeysOfOthers", "/integrator/type", "\"avi\"", "integrator.min_degree", "type or resonance"},
    {"AviUnderOneClock", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "avi"}, "schedule": {"type": "lockstep"}, "control": {"type": "fixed", "step": 1}})",
     "schedule.type", "asynchronous"},
    {"AviWithoutSteps", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "avi"}, "control": {"type": "fixed"}})",
     "control", "a step, a fraction courant, or both"},
    {"AviWithoutStiffness", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "gravity"}], "integrator": {"type": "avi"}, "control": {"type": "fixed", "courant": 0.1}})",
     "control.courant",
     "no stiffness is known of gravity, so that nothing bounds its step; leave courant out and give a step"},
    {"AviWithDragAndCourant", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "drag", "coefficient": 1}], "integrator": {"type": "avi"}, "control": {"courant": 0.1}})",
     "integrator.type", "its force depends on velocities"},
    {"AviWithStepsForOtherForces", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "gravity"}], "integrator": {"type": "avi"}, "control": {"type": "fixed", "step": [1, 2]}})",
     "control.step", "one for each force"},
    {"SubcyclingWithDrag", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "drag", "coefficient": 1}],
         "integrator": {"type": "subcycling", "coarse": [1], "ratio": 2}, "control": {"type": "fixed", "step": 1}})",
     "integrator.type", "drag depends on velocities"},
    {"SubcyclingWithKeysOfOthers", "", subcycling_with(R"("ratio": 2, "implicit": [1])"),
     "integrator.implicit", "type, coarse, ratio or resonance"},
    {"SubcyclingWithoutRatio", "", subcycling_with(R"("coarse": [2])"), "integrator.ratio", "missing"},
    {"SubcyclingRatioBelowOne", "", subcycling_with(R"("coarse": [2], "ratio": 0.5)"), "integrator.ratio",
     "got 0.5; must be a number from 1"},
    {"SubcyclingRatioBeyondBounds", "", subcycling_with(R"("coarse": [2], "ratio": 1e10)"),
     "integrator.ratio", "to 1e9"},
    {"SubcyclingRatioNotANumber", "", subcycling_with(R"("coarse": [2], "ratio": true)"), "integrator.ratio",
     "a number from 1"},
    {"SubcyclingRatioOfText", "", subcycling_with(R"("coarse": [2], "ratio": "large")"), "integrator.ratio",
     "or \"courant\""},
    {"SubcyclingRatioForNobody", "", subcycling_with(R"("ratio": 2)"), "integrator.ratio",
     "where integrator.coarse is left out"},
    {"SubcyclingRatiosWithCoarse", "", subcycling_with(R"("coarse": [2], "ratio": [1, 1, 2, 2])"),
     "integrator.ratio", "a number from 1"},
    {"SubcyclingTooFewRatios", "", subcycling_with(R"("ratio": [1, 1, 2])"), "integrator.ratio",
     "one for each particle"},
    {"SubcyclingOneRatioBelowOne", "", subcycling_with(R"("ratio": [1, 1, 0, 2])"), "integrator.ratio[2]",
     "got 0"},
    {"SubcyclingCoarseEmpty", "", subcycling_with(R"("coarse": [], "ratio": 2)"), "integrator.coarse",
     "at least one particle"},
    {"SubcyclingCoarseNotAList", "", subcycling_with(R"("coarse": 2, "ratio": 2)"), "integrator.coarse",
     "a list"},
    {"SubcyclingCoarseUnknown", "", subcycling_with(R"("coarse": [1, 4], "ratio": 2)"),
     "integrator.coarse[1]", "from 0 to 3"},
    {"SubcyclingCoarseNegative", "", subcycling_with(R"("coarse": [-1], "ratio": 2)"), "integrator.coarse[0]",
     "from 0 to 3"},
    {"SubcyclingCoarseNotWhole", "", subcycling_with(R"("coarse": [1.5], "ratio": 2)"),
     "integrator.coarse[0]", "a whole number"},
    {"SubcyclingCoarseFixed", "", subcycling_with(R"("coarse": [0], "ratio": 2)"), "integrator.coarse[0]",
     "not fixed"},
    {"SubcyclingCoarseTwice", "", subcycling_with(R"("coarse": [1, 1], "ratio": 2)"), "integrator.coarse[1]",
     "not in the list already"},
    {"SubcyclingByCourantWithoutIt", "", subcycling_with(R"("coarse": [2], "ratio": "courant")"),
     "control.courant", "missing"},
    {"SubcyclingByCourantAndAStep", "",
     subcycling_with(R"("ratio": "courant")", R"("step": 0.1, "courant": 0.5)"), "control.step",
     "allowed here: type or courant"},
    {"SubcyclingByCourantWithoutStiffness", "",
     R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "gravity"}], "integrator": {"type": "subcycling", "ratio": "courant"},
         "control": {"type": "fixed", "courant": 0.1}})",
     "control.courant", "no particle has a stiffness"},
    {"SubcyclingStepOfText", "", subcycling_with(R"("coarse": [2], "ratio": 2)", R"("step": "short")"),
     "control.step", "> 0"},
    {"SubcyclingStepOverflows", "", subcycling_with(R"("coarse": [2], "ratio": 1e6)", R"("step": 1e303)"),
     "integrator.type", "step"},
    {"SubcyclingResonanceUnknown", "",
     subcycling_with(R"("coarse": [2], "ratio": 2, "resonance": "forbidden")"), "integrator.resonance",
     "allowed or avoided"},
    {"SubcyclingResonanceBeyondTheLimit", "",
     subcycling_with(R"("coarse": [2], "ratio": 2, "resonance": "avoided")", R"("step": 0.5)"),
     "integrator.resonance", "below 2/omega"},
    {"SubcyclingWithAnotherControl", "/integrator", R"({"type": "subcycling", "coarse": [1], "ratio": 2})",
     "schedule.type", "asynchronous"},
    {"ConradAroundSubcycling", "/integrator",
     R"({"type": "conrad", "order": 2, "inner": {"type": "subcycling"}})", "integrator.inner.type",
     "got \"subcycling\""},
    {"ExplicitImplicitWithoutPartition", "", springs_with(R"("type": "explicit_implicit")"),
     "integrator.implicit", "missing"},
    {"ExplicitImplicitEmpty", "", partition("[]"), "integrator.implicit", "at least one particle"},
    {"ExplicitImplicitOfANumber", "", partition("1"), "integrator.implicit", "a list"},
    {"ExplicitImplicitOfText", "", partition("\"stiff\""), "integrator.implicit", "or \"courant\""},
    {"ExplicitImplicitUnknown", "", partition("[1, 7]"), "integrator.implicit[1]", "from 0 to 3"},
    {"ExplicitImplicitFixed", "", partition("[0]"), "integrator.implicit[0]", "not fixed"},
    {"ExplicitImplicitTwice", "", partition("[2, 1, 2]"), "integrator.implicit[2]",
     "not in the list already"},
    {"ExplicitImplicitWithCourantControl", "",
     springs_with(R"("type": "explicit_implicit", "implicit": [1])", R"("step": 0.1, "courant": 0.5)"),
     "control.courant", "unknown key"},
    {"ExplicitImplicitByCourantWithoutStiffness", "",
     R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1, "forces": [{"type": "gravity"}],
         "integrator": {"type": "explicit_implicit", "implicit": "courant"}, "control": {"type": "fixed", "step": 0.1}})",
     "integrator.implicit", "no force of this scene has a stiffness"},
    {"ExplicitImplicitByCourantInside", "",
     springs_with(
         R"("type": "random_step", "order": 2, "inner": {"type": "explicit_implicit", "implicit": "courant"})"),
     "integrator.inner.implicit", "inside another method"},
    {"QssWithAStep", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "qss2"}, "control": {"type": "fixed", "step": 1}})",
     "control", "quantum, velocity_quantum or max_step"},
    {"QssWithoutQuantum", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "qss1"}, "control": {"type": "quantum"}})",
     "control.quantum", "missing"},
    {"QssOfQuantumZero", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "qss3"}, "control": {"quantum": 0}})",
     "control.quantum", "> 0"},
    {"QssOfAFixedControl", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "qss3"}, "control": {"type": "fixed", "quantum": 1}})",
     "control.type", "quantum, which is what qss3 works with"},
    {"QssUnderOneClock", "", R"({"particles": {"position": [[0], [1]]}, "dimension": 1, "until": 1,
         "integrator": {"type": "qss2"}, "schedule": {"type": "lockstep"}, "control": {"quantum": 1}})",
     "schedule.type", "asynchronous"},
    {"QssOnAFloorWithoutLongestStep", "",
     R"({"particles": {"position": [[1], [2]]}, "dimension": 1, "until": 1,
         "forces": [{"type": "floor", "stiffness": 1}], "integrator": {"type": "qss2"}, "control": {"quantum": 1}})",
     "control", "give a max_step"},
    {"QssInsideConrad", "/integrator", R"({"type": "conrad", "order": 2, "inner": {"type": "qss1"}})",
     "integrator.inner.type", "got \"qss1\""},
    {"ClocksNotABoolean", "/output/clocks", "3", "output.clocks", "true or false"},
    {"UnknownIntegrator", "/integrator/type", "\"eiler\"", "integrator.type",
     "taylor, random_taylor, leapfrog"},
    {"SymplecticEulerWithDrag", "/integrator", R"({"type": "symplectic_euler"})", "integrator.type",
     "depends on velocities"},
    {"Rk4WithATolerance", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "rk4"},
         "control": {"type": "embedded", "tolerance": 1e-9}})",
     "control.type", "embedded"},
    {"Dopri5WithJorbaZou", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "dopri5"},
         "control": {"type": "jorba_zou"}})",
     "control.type", "fixed or embedded"},
    {"Dop853WithoutTolerance", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "dop853"},
         "control": {"type": "embedded"}})",
     "control.tolerance", "missing"},
    {"HermiteWithoutIterations", "/integrator", R"({"type": "hermite", "iterations": 0})",
     "integrator.iterations", "from 1"},
    {"ImplicitSubcyclingWithoutRatio", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "control": {"type": "fixed", "step": 1},
         "integrator": {"type": "implicit_subcycling", "coarse": [0]}})",
     "integrator.ratio", "missing"},
    {"ImplicitSubcyclingOfRatioZero", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "control": {"type": "fixed", "step": 1},
         "integrator": {"type": "implicit_subcycling", "ratio": 0, "coarse": [0]}})",
     "integrator.ratio", "from 1"},
    {"ImplicitSubcyclingOfAParticleThatDoesNotExist", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "control": {"type": "fixed", "step": 1},
         "integrator": {"type": "implicit_subcycling", "ratio": 2, "coarse": [1]}})",
     "integrator.coarse[0]", "got 1"},
    {"ImplicitSubcyclingOfAParticleNamedTwice", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "control": {"type": "fixed", "step": 1},
         "integrator": {"type": "implicit_subcycling", "ratio": 2, "coarse": [0, 0]}})",
     "integrator.coarse[1]", "not in the list already"},
    {"ConradWithoutInner", "/integrator", R"({"type": "conrad", "order": 2})", "integrator.inner", "missing"},
    {"ConradInConrad", "/integrator", R"({"type": "conrad", "order": 2, "inner": {"type": "conrad"}})",
     "integrator.inner.type", "got \"conrad\""},
    {"ConradAroundAvi", "/integrator", R"({"type": "conrad", "order": 2, "inner": {"type": "avi"}})",
     "integrator.inner.type", "got \"avi\""},
    {"RandomStepOfLowOrder", "/integrator",
     R"({"type": "random_step", "order": 0.5, "inner": {"type": "rk4"}})", "integrator.order", "> 0.5"},
    {"RandomStepOfASecond", "",
     R"({"until": 9, "dimension": 1, "particles": {"position": [[0]]},
         "integrator": {"type": "random_step", "order": 2, "inner": {"type": "rk4"}},
         "control": {"type": "fixed", "step": 1}})",
     "integrator.type", "must be < 1 s"},
    {"MinDegreeZero", "/integrator/min_degree", "0", "integrator.min_degree", "from 1"},
    {"MaxBelowMin", "/integrator/max_degree", "2", "integrator.max_degree", "from 3"},
    {"ProbabilityTwo", "/integrator/probability", "2", "integrator.probability", "from 0 to 1"},
    {"ProbabilityOne", "/integrator/probability", "1", "integrator.probability", "never draw"},
    {"UnknownDraws", "/integrator/draws", "\"dice\"", "integrator.draws", "independent"},
    {"UnknownLaw", "/integrator/law", "\"zipf\"", "integrator.law",
     "geometric, poisson, tail, variance_capped, sequential or single_term"},
    {"KeyOfAnotherLaw", "/integrator/mean", "2", "integrator.mean", "unknown key"},
    {"ProbabilityBesideBase", "/integrator",
     R"({"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.5, "base": 2})",
     "integrator.base", "left out"},
    {"BaseOne", "/integrator", R"({"type": "random_taylor", "min_degree": 3, "max_degree": 6, "base": 1})",
     "integrator.base", "from 2"},
    {"RulerOfThreeTenths", "/integrator",
     R"({"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.3, "draws": "ruler"})",
     "integrator.draws", "term 4 is 0.7"},
    {"StrataOfASharedDraw", "/integrator",
     R"({"type": "random_taylor", "min_degree": 3, "max_degree": 6, "draws": "stratified"})",
     "integrator.draws", "over particles"},
    {"PoissonWithoutMean", "/integrator",
     R"({"type": "random_taylor", "law": "poisson", "min_degree": 3, "max_degree": 6})", "integrator.mean",
     "is missing"},
    {"PoissonOfNegativeMean", "/integrator",
     R"({"type": "random_taylor", "law": "poisson", "min_degree": 3, "max_degree": 6, "mean": -1})",
     "integrator.mean", "> 0"},
    {"PoissonOverflow", "/integrator",
     R"({"type": "random_taylor", "law": "poisson", "min_degree": 3, "max_degree": 250, "mean": 0.1})",
     "integrator.mean", "overflows"},
    {"TailThatRises", "/integrator", R"({"type": "random_taylor", "law": "tail", "tail": [1, 1, 0.2, 0.3]})",
     "integrator.tail", "P(K >= 3)"},
    {"TailOfZero", "/integrator", R"({"type": "random_taylor", "law": "tail", "tail": [1, 1, 0]})",
     "integrator.tail[2]", "> 0"},
    {"TailBelowOneAtOne", "/integrator", R"({"type": "random_taylor", "law": "tail", "tail": [1, 0.5]})",
     "integrator.tail", "P(K >= 1) must be 1"},
    {"CapWithoutTerms", "/integrator",
     R"({"type": "random_taylor", "law": "variance_capped", "max_variance": 1e-3})", "integrator.terms",
     "is missing"},
    {"CapOfZero", "/integrator",
     R"({"type": "random_taylor", "law": "variance_capped", "terms": [1, 1, 0.5], "max_variance": 0})",
     "integrator.max_variance", "> 0"},
    {"CapOfTermsThatVanish", "/integrator",
     R"({"type": "random_taylor", "law": "variance_capped", "terms": [1, 0, 0], "max_variance": 1})",
     "integrator.terms", "other than 0"},
    {"SequentialWithoutTarget", "/integrator",
     R"({"type": "random_taylor", "law": "sequential", "min_degree": 3, "max_degree": 6})",
     "integrator.target", "is missing"},
    {"SequentialWithARuler", "/integrator",
     R"({"type": "random_taylor", "law": "sequential", "min_degree": 3, "max_degree": 6, "target": 1, "draws": "ruler"})",
     "integrator.draws", "sequential"},
    {"UnknownControl", "/control/type", "\"pid\"", "control.type",
     "fixed, jorba_zou, last_two, variance or halve_double"},
    {"ZeroStep", "/control/step", "0", "control.step", "> 0"},
    {"NegativeStep", "/control/step", "-0.1", "control.step", "got -0.1"},
    {"CourantTwo", "/control/courant", "2", "control.courant", "<= 1"},
    {"CourantOfUnstableDegree", "/control/courant", "0.9", "control.courant", "unstable"},
    {"SequentialWithVariance", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]},
         "integrator": {"type": "random_taylor", "law": "sequential", "min_degree": 3, "max_degree": 6, "target": 1},
         "control": {"type": "variance", "step": 1, "tolerance_random": 1, "tolerance_bias": 1}})",
     "control", "need the variance"},
    {"HalveDoubleThresholds", "/control",
     R"({"type": "halve_double", "step": 0.01, "max_step": 0.01, "min_variance": 1e-9, "max_variance": 1e-8})",
     "control", "4^(min_degree+1)"},
    {"LeapfrogWithJorbaZou", "/integrator", R"({"type": "leapfrog", "degree": 2})", "integrator.degree",
     "unknown key"},
    {"ToleranceOfText", "/control", R"({"type": "jorba_zou", "tolerance": "x"})", "control.tolerance",
     "left out"},
    {"ToleranceBesideDegree", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "taylor", "degree": 9},
         "control": {"type": "jorba_zou", "tolerance": 1e-9}})",
     "control.tolerance", "1e-09"},
    {"ToleranceOfTwo", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "taylor"},
         "control": {"type": "jorba_zou", "tolerance": 2}})",
     "control.tolerance", "between 0 and 1"},
    {"ToleranceBeyondTheLargestDegree", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "taylor"},
         "control": {"type": "jorba_zou", "tolerance": 1e-300}})",
     "control.tolerance", "degree 347, beyond 256"},
    {"NeitherDegreeNorTolerance", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "taylor"},
         "control": {"type": "jorba_zou"}})",
     "integrator.degree", "missing"},
    {"ToleranceOfAFixedStep", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "taylor", "degree": 4},
         "control": {"type": "fixed", "step": 1, "tolerance": 1e-9}})",
     "control.tolerance", "unknown key"},
    {"CompensatedText", "/integrator/compensated", "\"yes\"", "integrator.compensated", "true or false"},
    {"CompensatedLeapfrog", "/integrator", R"({"type": "leapfrog", "compensated": true})",
     "integrator.compensated", "unknown key"},
    {"CourantWithoutStiffness", "",
     R"({"until": 1, "dimension": 1, "particles": {"position": [[0]]}, "integrator": {"type": "leapfrog"},
         "control": {"type": "fixed", "step": 1, "courant": 0.5}})",
     "control.courant", "stiffness"},
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
    {"ZeroFrames", "/output/frames", "0", "output.frames", "from 1"},
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
  refused(head + points + "Tetrahedra\n2\n1 2 3 4 0\n1 3 2 4 0\n", "inverted");
  refused(head + points + "Surprise\n1\n", "Surprise");
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
