// SPDX-License-Identifier: MIT
// Runs whose numbers are still finite but not their energies: they end as non_finite, with the last good state.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// v' = -1000 v at steps of 0.01, far beyond every limit of an explicit method: |v| grows 4-fold (leapfrog) to 291-fold
/// (rk4) and more a step, and passes 1e150 but not 1e308 within the second that is run.
std::string drag_with(const std::string& integrator, const std::string& keys = "") {
  return R"({"dimension": 1, "particles": {"position": [[0]], "velocity": [[1]]},
    "forces": [{"type": "drag", "coefficient": 1000}], "until": 1, "integrator": )" +
         integrator + R"(, "control": {"type": "fixed", "step": 0.01},
    "output": {"frames": 20, "pictures": false})" +
         keys + "}";
}

class BlownUp : public ::testing::TestWithParam<const char*> {};

TEST_P(BlownUp, EndsWhereSquaresOverflowWithNumbersInEveryOutput) {
  const TemporaryFolder folder;
  write(folder / "scene.json", drag_with(GetParam()));
  const Ended run = program("run scene.json --out out", folder.path());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  EXPECT_THAT(run.output, HasSubstr("particle 0"));
  EXPECT_THAT(run.output, Not(HasSubstr("inf J")));
  const std::string text = content(folder / "out/summary.json");
  const Json summary = Json::parse(text);
  EXPECT_EQ(summary["outcome"], "non_finite");
  EXPECT_THAT(text, Not(HasSubstr("null")));
  EXPECT_LT(std::abs(summary["velocity"][0][0].get<double>()), 1e150);
  EXPECT_GT(std::abs(summary["velocity"][0][0].get<double>()),
            1e140);  // where the limit was passed, not a frame before
  const std::string table = content(folder / "out/energy.csv");
  EXPECT_THAT(table, Not(HasSubstr(",,")));
  EXPECT_THAT(table, Not(HasSubstr(",\n")));
}

INSTANTIATE_TEST_SUITE_P(
    OneClock, BlownUp,
    ::testing::Values(R"({"type": "rk4"})", R"({"type": "leapfrog"})",
                      R"({"type": "conrad", "inner": {"type": "rk4"}, "order": 4, "sigma": 1})",
                      R"({"type": "taylor", "degree": 4})", R"({"type": "hermite"})"));

TEST(BlownUp, EndsAtAFrameWhereParticlesHaveClocksOfTheirOwn) {
  for (const char* schedule : {"block", "asynchronous"}) {
    const RunResult result = run_scene(read_scene(
        R"({"dimension": 1, "particles": {"position": [[0]], "velocity": [[1]]},
        "forces": [{"type": "drag", "coefficient": 1000}], "until": 1, "output": {"frames": 20},
        "integrator": {"type": "taylor", "degree": 4},
        "schedule": {"max_step": 0.01, "tolerance": 1e300, "type": ")" +
            std::string(schedule) + "\"}}",
        "test", "."));
    EXPECT_EQ(result.summary.outcome, Outcome::non_finite) << schedule;
    EXPECT_THAT(result.summary.message, HasSubstr("particle 0")) << schedule;
    EXPECT_TRUE(std::isfinite(result.summary.final_energy.total())) << schedule;
    EXPECT_LT(result.summary.velocity.cwiseAbs().maxCoeff(), 1e150) << schedule;
  }
}

TEST(BlownUp, CanBeAnEnergyOfSmallNumbers) {  // m v^2 / 2 = 5e309 t^2 J
  const RunResult result = run_scene(read_scene(
      R"({"dimension": 1, "particles": {"position": [[0]], "mass": 1e110},
      "forces": [{"type": "uniform_field", "acceleration": [1e100]}], "until": 1, "output": {"frames": 10},
      "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 0.01}})",
      "test", "."));
  EXPECT_EQ(result.summary.outcome, Outcome::non_finite);
  EXPECT_THAT(result.summary.message, HasSubstr("energy at t = 0.2 is not finite, and particle 0"));
  EXPECT_EQ(result.summary.time, 0.1);
  EXPECT_TRUE(std::isfinite(result.summary.final_energy.total()));
}

TEST(BlownUp, IsRefusedAtTheBeginning) {
  EXPECT_THROW(
      read_scene(R"({"dimension": 1, "particles": {"position": [[0]], "velocity": [[1e100]], "mass": 1e110},
      "until": 1, "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 0.01}})",
                 "test", "."),
      SceneError);
}

// ---- energies that ought to stay ---------------------------------------------------------------------------

/// A mass on a spring, omega = 10 rad/s, at rest 1 m from where the spring ends, with other forces besides.
RunResult oscillation(const std::string& step, const std::string& forces = "") {
  return run_scene(read_scene(
      R"({"dimension": 1, "particles": {"position": [[0], [2]], "fixed": [0]}, "until": 3,
      "forces": [{"type": "spring", "pairs": [[0, 1]], "stiffness": 100, "rest_length": 1})" +
          forces + R"(], "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": )" + step +
          "}}",
      "test", "."));
}

TEST(ConservedEnergy, ThatChangesIsAWarning) {
  // Leapfrog is unstable beyond h = 2/omega = 0.2 s; below, its energy error is (omega h / 2)^2 = 0.0025 at h = 0.01.
  const Summary unstable = oscillation("0.21").summary, stable = oscillation("0.01").summary;
  EXPECT_EQ(unstable.outcome, Outcome::success);
  ASSERT_EQ(unstable.warnings.size(), 1u);
  EXPECT_THAT(unstable.warnings[0], HasSubstr("energy is conserved by this scene but changed by"));
  EXPECT_THAT(unstable.warnings[0], HasSubstr("take a smaller step or tolerance"));
  EXPECT_TRUE(stable.warnings.empty());
}

TEST(ConservedEnergy, IsNotThatOfADampedScene) {
  const Summary damped = oscillation("0.01", R"(, {"type": "drag", "coefficient": 1})").summary;
  EXPECT_GT(damped.max_relative_energy_error, 0.5);
  EXPECT_TRUE(damped.warnings.empty());
}

TEST(ConservedEnergy, MayBeSmallBecauseItsPartsCancel) {
  // E = 50 J of the spring - 49.999999 J in the field; the error, (omega h / 2)^2 = 2.5e-5 of the 28 J that move, is
  // hundreds of times what is left.
  const Summary cancelled =
      oscillation("0.001", R"(, {"type": "uniform_field", "acceleration": [24.9999995]})").summary;
  EXPECT_LT(std::abs(cancelled.initial_energy.total()), 1e-5);
  EXPECT_GT(cancelled.max_relative_energy_error, 0.1);
  EXPECT_TRUE(cancelled.warnings.empty());
}

}  // namespace
}  // namespace jetlag::testing
