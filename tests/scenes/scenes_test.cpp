// SPDX-License-Identifier: MIT
// Scenes as users run them: the contracts of the scene file and of the summary.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using Json = nlohmann::json;

Json summary_of(const std::string& arguments) {
  const TemporaryFolder folder;
  const Ended run =
      program("run " + arguments + " --quiet --out out --set output.pictures=false", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return Json::parse(content(folder / "out/summary.json"));
}

TEST(Scenes, AllBuiltInOnesAreListedValidAndComplete) {
  const TemporaryFolder folder;
  const std::string list = program("scenes", folder.path()).output;
  for (const auto& scene : built_in_scenes()) {
    EXPECT_NE(list.find(scene.name), std::string::npos);
    EXPECT_EQ(program("check " + scene.name, folder.path()).exit_code, 0);
    const Ended show = program("show " + scene.name, folder.path());
    ASSERT_EQ(show.exit_code, 0);
    // What `show` prints is a scene file that says the same.
    EXPECT_EQ(read_scene(show.output, "show", folder.path()).json, load_scene(scene.name).json);
  }
}

TEST(Scenes, LeaveWhatTheContractPromises) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("run chain --out out --set output.frames=7 --set until=0.5", folder.path()).exit_code, 0);
  for (const char* name :
       {"summary.json", "scene.json", "energy.csv", "frames/run.pvd", "frames/frame_000007.vtu"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frames/frame_000008.vtu"));
  const Json summary = Json::parse(content(folder / "out/summary.json"));
  EXPECT_EQ(summary["outcome"], "success");
  EXPECT_EQ(summary["time"], 0.5);
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["position"].size(), 3u);
  EXPECT_EQ(summary["position"][0][0], 0.0);  // fixed
  EXPECT_EQ(summary["work"]["updates"], 2 * summary["work"]["steps"].get<int>());
  for (const char* key : {"energy", "momentum", "wall_seconds", "version", "instruction_set", "threads"})
    EXPECT_TRUE(summary.contains(key)) << key;
}

TEST(Scenes, FewerFramesThanBeforeLeaveNoOldOnes) {
  const TemporaryFolder folder;
  for (const char* frames : {"9", "3"})
    ASSERT_EQ(program(std::string("run chain --out out --set until=0.1 --set output.frames=") + frames,
                      folder.path())
                  .exit_code,
              0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frames/frame_000003.vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frames/frame_000004.vtu"));
}

TEST(Scenes, RemoveOnlyWhatTheyLeave) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "out/frames");
  for (const char* name : {"out/frames/mine.vtu", "out/frames/frame_1.vtu", "out/notes.txt"})
    write(folder / name, "mine");
  ASSERT_EQ(program("run chain --out out --set until=0.1 --quiet", folder.path()).exit_code, 0);
  for (const char* name : {"out/frames/mine.vtu", "out/frames/frame_1.vtu", "out/notes.txt"})
    EXPECT_EQ(content(folder / name), "mine");
}

TEST(Scenes, TwoBodyEndsWhereItBegan) {  // after 100 periods; reference: Kepler's orbit is closed
  const Json summary = summary_of("two_body");
  EXPECT_LT(summary["energy"]["max_relative_error"].get<double>(), 1e-13);
  // A relative energy error e shifts the phase by 3 pi e each period, 100 periods: below 1e-10 for e = 1e-13.
  EXPECT_NEAR(summary["position"][1][0].get<double>(), 0.5, 1e-10);
  EXPECT_NEAR(summary["position"][1][1].get<double>(), 0.0, 1e-10);
}

TEST(Scenes,
     FramesAreTakenFromTheMotionAtTheirTimes) {  // a free particle on a parabola: exact for any degree >= 2
  const Scene scene =
      read_scene(R"({"dimension": 2, "particles": {"position": [[0, 0]], "velocity": [[1, 2]]},
    "forces": [{"type": "uniform_field", "acceleration": [0, -9.8]}], "integrator": {"type": "taylor", "degree": 4},
    "control": {"type": "fixed", "step": 0.3}, "until": 1, "output": {"frames": 8}})",
                 "test", ".");
  std::vector<double> times;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    const double t = frame.time;
    times.push_back(t);
    EXPECT_NEAR(frame.position(0, 0), t, 4e-16);  // a few roundings of numbers below 2
    EXPECT_NEAR(frame.position(0, 1), 2 * t - 4.9 * t * t, 4e-15);
    EXPECT_NEAR(frame.velocity(0, 1), 2 - 9.8 * t, 4e-15);
  };
  const RunResult result = run_scene(scene, hooks);
  EXPECT_EQ(times, (std::vector<double>{0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1}));
  EXPECT_EQ(result.energies.size(), 9u);
  EXPECT_EQ(result.summary.work.steps, 4u);
}

TEST(Scenes, GiveEveryElementAClockAndShowIt) {
  const Scene scene = load_scene(
      "chain", {R"(forces=[{"type": "spring", "pairs": [[0, 1]], "stiffness": 5000, "rest_length": 1},
                           {"type": "spring", "pairs": [[1, 2]], "stiffness": 1, "rest_length": 1}])",
                R"(integrator={"type": "avi"})", R"(control={"step": [0.001, 0.01]})", "until=1",
                "output.clocks=true"});
  const RunResult result = run_scene(scene);
  EXPECT_EQ(result.summary.outcome, Outcome::success);
  EXPECT_EQ(result.summary.time, 1.0);
  EXPECT_EQ(result.summary.work.element_coefficients, 1001u + 101u);
  EXPECT_EQ(result.energies.size(), 101u);
  // Leapfrog's error of the stiff spring, (omega h)^2 / 4, of the impulses of the soft one on it less than a tenth.
  EXPECT_LT(result.summary.max_relative_energy_error, 0.01);
  ASSERT_TRUE(result.clocks);
  for (const Update& update : result.clocks->rows())
    EXPECT_NEAR(update.step, update.particle == 1 ? 0.001 : 0.01, 1e-15);
  EXPECT_EQ(result.clocks->rows().size(), 1000u + 100u);
}

/// Wall-100-mass-1-mass-1-mass-1-wall under a method, until 1.
RunResult run_of_three_masses(const std::string& integrator, const std::string& control) {
  return run_scene(read_scene(
      R"({"dimension": 1, "particles": {"position": [[0], [1], [2], [3], [4]], "velocity": [[0], [1], [0], [0], [0]],
           "fixed": [0, 4]},
          "forces": [{"type": "spring", "pairs": [[0, 1], [1, 2], [2, 3], [3, 4]], "stiffness": [100, 1, 1, 1],
                      "rest_length": 1}],
          "integrator": )" +
          integrator + R"(, "control": )" + control +
          R"(, "until": 1, "output": {"frames": 1, "clocks": true}})",
      "test", "."));
}

/// The steps of particles 1, 2 and 3.
std::vector<double> steps_of(const std::string& integrator, const std::string& control) {
  std::vector<double> steps(3);
  const RunResult result = run_of_three_masses(integrator, control);
  EXPECT_EQ(result.summary.outcome, Outcome::success);
  for (const Update& update : result.clocks->rows())
    if (update.begin == 0) steps[update.particle - 1] = update.step;
  return steps;
}

TEST(Scenes, GiveParticlesStepsInAnyRatio) {
  using ::testing::ElementsAre;
  // The limits 2/omega: omega^2 of particles 1 and 2 is 101 + 2, of 3 it is 2 + 2.
  const double stiff = 2 / std::sqrt(103.0);
  const auto about = [](double step) { return ::testing::DoubleNear(step, 1e-15); };
  EXPECT_THAT(steps_of(R"({"type": "subcycling", "coarse": [3, 2], "ratio": 2.5})", R"({"step": 0.01})"),
              ElementsAre(about(0.01), about(0.025), about(0.025)));
  EXPECT_THAT(
      steps_of(R"({"type": "subcycling", "ratio": [9, 1, 2, 3.5, 9]})", R"({"type": "fixed", "step": 0.01})"),
      ElementsAre(about(0.01), about(0.02), about(0.035)));
  EXPECT_THAT(steps_of(R"({"type": "subcycling", "ratio": "courant"})", R"({"courant": 0.25})"),
              ElementsAre(about(0.25 * stiff), about(0.25 * stiff), about(0.25)));
  EXPECT_THAT(steps_of(R"({"type": "subcycling", "coarse": [3], "ratio": "courant"})",
                       R"({"courant": 0.25, "step": 0.01})"),
              ElementsAre(about(0.01), about(0.01), about(0.25)));
  EXPECT_THAT(steps_of(R"({"type": "subcycling", "coarse": [3], "ratio": 3})", R"({"courant": 0.25})"),
              ElementsAre(about(0.25 * stiff), about(0.25 * stiff), about(0.75 * stiff)));
  EXPECT_THAT(steps_of(R"({"type": "subcycling", "coarse": [3], "ratio": 9, "resonance": "avoided"})",
                       R"({"step": 0.03})"),
              ElementsAre(about(0.03), about(0.03), about(0.12)));
}

TEST(Scenes, TreatParticlesImplicitlyBeyondTheirLimit) {
  // h = 0.5 is beyond 2/sqrt(103) and below 1: particles 1 and 2.
  const std::string control = R"({"type": "fixed", "step": 0.5})";
  const auto x = [&](const std::string& implicit) {
    return run_of_three_masses(R"({"type": "explicit_implicit", "implicit": )" + implicit + "}", control)
        .summary.position;
  };
  EXPECT_EQ(x("\"courant\""), x("[1, 2]"));
  EXPECT_NE(x("\"courant\""), x("[1, 2, 3]"));
}

TEST(Scenes, QuantizeTheStateAndShowItsClocks) {
  // The quantum of velocities is that of positions, a second long, where nothing else is said.
  const auto steps = [](const std::string& control) {
    const Scene scene = load_scene(
        "chain", {R"(integrator={"type": "qss2"})", "control=" + control, "until=1", "output.clocks=true"});
    const RunResult result = run_scene(scene);
    EXPECT_EQ(result.summary.outcome, Outcome::success);
    EXPECT_EQ(result.summary.time, 1.0);
    EXPECT_TRUE(result.clocks && !result.clocks->rows().empty());
    for (const Update& update : result.clocks->rows()) EXPECT_GT(update.step, 0);
    return result.summary.work.steps;
  };
  const auto same = steps(R"({"quantum": 1e-4})");
  EXPECT_EQ(steps(R"({"type": "quantum", "quantum": 1e-4, "velocity_quantum": 1e-4})"), same);
  EXPECT_LT(steps(R"({"quantum": 1e-4, "velocity_quantum": 1e-3})"), same);
  EXPECT_GT(steps(R"({"quantum": 1e-4, "velocity_quantum": 1, "max_step": 1e-4})"), 10000u);
}

TEST(Scenes, SameSeedSameBitsOtherSeedOtherBits) {
  const std::string scene = "body --set until=0.2 --set output.frames=2";
  const Json a = summary_of(scene), b = summary_of(scene), c = summary_of(scene + " --seed 2");
  EXPECT_EQ(a["position"], b["position"]);
  EXPECT_EQ(a["velocity"], b["velocity"]);
  EXPECT_NE(a["position"], c["position"]);
}

TEST(Scenes, CanBeRepeatedFromWhatTheyLeave) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("run cloth --out a --set until=0.1 --set output.pictures=false --seed 7", folder.path())
                .exit_code,
            0);
  ASSERT_EQ(program("run a/scene.json --out b", folder.path()).exit_code, 0);
  EXPECT_EQ(content(folder / "a/scene.json"), content(folder / "b/scene.json"));
  EXPECT_EQ(content(folder / "a/frames/frame_000100.vtu"), content(folder / "b/frames/frame_000100.vtu"));
}

TEST(Scenes, OrderAndDirectionOfSpringsDoNotMatter) {
  const auto end = [](const char* springs) {
    const std::string text =
        std::string(R"({"dimension": 3, "particles": {"position": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]],
      "velocity": [[0.1,0,0],[0,0.2,0],[0,0,0.3],[0.1,0.1,0]]}, "forces": [{"type": "spring", )") +
        springs + R"(}],
      "integrator": {"type": "taylor", "degree": 8}, "control": {"type": "fixed", "step": 0.05}, "until": 2,
      "output": {"frames": 1}})";
    return run_scene(read_scene(text, "test", ".")).summary.position;
  };
  const auto a = end(
      R"("pairs": [[0,1],[0,2],[1,2],[2,3],[0,1]], "stiffness": [1,2,3,4,5], "rest_length": [1,1,1,1,0.5])");
  const auto b = end(
      R"("pairs": [[3,2],[1,0],[2,1],[1,0],[2,0]], "stiffness": [4,5,3,1,2], "rest_length": [1,0.5,1,1,1])");
  EXPECT_EQ(a, b);  // bit for bit
}

TEST(Scenes, SettingsReachEveryValue) {
  const Scene scene = load_scene("chain",
                                 {"forces[0].stiffness[1]=2.5", "control.step=0.01", "name=other",
                                  "output={\"frames\": 3}", "particles.mass=[1,2,3]"},
                                 9);
  const auto json = Json::parse(scene.json);
  EXPECT_EQ(json["forces"][0]["stiffness"], (std::vector<double>{5000, 2.5}));
  EXPECT_EQ(json["control"]["step"], 0.01);
  EXPECT_EQ(json["name"], "other");
  EXPECT_EQ(json["seed"], 9);
  EXPECT_EQ(scene.output.frames, 3);
  EXPECT_EQ(scene.system->mass(), (std::vector<double>{1, 2, 3}));
}

TEST(Scenes, ForcesThatAreNotListedCostNothing) {
  const auto elements = [](const char* forces) {
    return read_scene(
               std::string(R"({"dimension": 1, "particles": {"position": [[0],[1]]}, "forces": [)") + forces +
                   R"(], "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 0.1}, "until": 1})",
               "test", ".")
        .system->elements()
        .size();
  };
  EXPECT_EQ(elements(""), 0u);
  EXPECT_EQ(elements(R"({"type": "gravity"})"), 1u);
}

TEST(Scenes, EveryIntegratorAndControlRuns) {
  const std::string ends = " --set until=0.2 --set output.frames=2";
  for (
      const char* method :
      {R"(--set integrator='{"type":"leapfrog"}')", R"(--set integrator='{"type":"taylor","degree":4}')",
       R"(--set integrator='{"type":"taylor","degree":7,"velocity":"derivative"}')",
       R"(--set integrator='{"type":"taylor"}' --set control='{"type":"jorba_zou","tolerance":1e-12}')",
       R"(--set integrator.shared_draw=false)", R"(--set integrator.velocity=derivative)",
       R"(--set integrator.max_degree=8 --set integrator.min_degree=6 --set control.courant=0.5)",
       R"(--set control='{"type":"variance","step":0.001,"max_step":0.01,"tolerance_random":1e-6,"tolerance_bias":1e-6}')",
       R"(--set control='{"type":"halve_double","step":0.001,"max_step":0.01,"min_variance":1e-16,"max_variance":1e-10}')"}) {
    const Json summary = summary_of("chain " + std::string(method) + ends);
    EXPECT_EQ(summary["time"], 0.2) << method;
  }
}

/// A run of the two bodies, e = .5, with an integrator and a control.
RunResult run_of_two_bodies(const std::string& integrator, const std::string& control, double until) {
  return run_scene(load_scene("two_body", {"integrator=" + integrator, "control=" + control,
                                           "until=" + std::to_string(until), "output.frames=1"}));
}

TEST(Scenes, ToleranceOfJorbaZouChoosesTheDegree) {
  for (const auto& [tolerance, degree] : {std::pair{"2.2e-16", 20}, {"1e-6", 8}, {"0.5", 2}}) {
    const RunResult result =
        run_of_two_bodies(R"({"type": "taylor"})",
                          R"({"type": "jorba_zou", "tolerance": )" + std::string(tolerance) + "}", 1.0);
    EXPECT_EQ(result.summary.work.mean_degree(), degree);
  }
}

TEST(Scenes, CompensatedSumsAreAnOptionThatIsOff) {
  const auto x = [](const std::string& compensated) {
    const std::string integrator = R"({"type": "taylor", "degree": 20)" + compensated + "}";
    return run_of_two_bodies(integrator, R"({"type": "jorba_zou"})", 20.0).summary.position;
  };
  const auto plain = x("");
  EXPECT_EQ(x(R"(, "compensated": false)"), plain);
  EXPECT_NE(x(R"(, "compensated": true)"), plain);
  EXPECT_LT((x(R"(, "compensated": true)") - plain).cwiseAbs().maxCoeff(),
            1e-12);  // 120 steps of some roundings
  EXPECT_NE(load_scene("two_body").json.find("\"compensated\": false"), std::string::npos);
}

TEST(FailedRuns, SayWhyAndLeaveTheLastGoodState) {
  const TemporaryFolder folder;
  // Two masses fall into each other: the speed grows without bound at t = pi / (2 sqrt 2) sqrt(1/8) ... in finite time.
  write(folder / "fall.json",
        R"({"dimension": 1, "particles": {"position": [[0], [1]]}, "forces": [{"type": "gravity"}],
    "integrator": {"type": "taylor", "degree": 12}, "control": {"type": "jorba_zou"}, "until": 5})");
  const Ended run = program("run fall.json --out out --quiet", folder.path());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  const std::string text = content(folder / "out/summary.json");
  const Json summary = Json::parse(text);
  EXPECT_NE(summary["outcome"], "success");
  // They meet at t = (pi/2) sqrt(r^3 / (2 G (m + m))) = pi/4, the free-fall time.
  EXPECT_NEAR(summary["time"].get<double>(), std::numbers::pi / 4, 1e-3);
  EXPECT_NE(summary["message"].get<std::string>().find("particle"), std::string::npos);
  EXPECT_EQ(text.find("null"), std::string::npos) << "not finite numbers in the summary";
  EXPECT_TRUE(std::isfinite(summary["position"][1][0].get<double>()));
}

TEST(FailedRuns, HaveAFrameAndAnEnergyOfTheLastGoodState) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("run chain --out out --set schedule.max_steps=5 --set output.frames=2", folder.path())
                .exit_code,
            3);
  std::istringstream lines(content(folder / "out/energy.csv"));
  std::string line, last;
  int rows = -1;
  while (std::getline(lines, line)) {
    ++rows;
    last = line;
  }
  EXPECT_EQ(rows, 2);  // at the beginning, and after five steps of 0.005 s
  EXPECT_NEAR(std::stod(last), 0.025, 1e-17);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frames/frame_000001.vtu"));
}

TEST(Runs, HaveTheSameBitsForAnyNumberOfThreads) {
  const auto positions = [](int threads) {
    const TemporaryFolder folder;
    const std::string command =
        "run body --out out --set until=0.02 --set output.pictures=false --set schedule.threads=";
    EXPECT_EQ(program(command + std::to_string(threads), folder.path()).exit_code, 0);
    const Json summary = Json::parse(content(folder / "out/summary.json"));
    EXPECT_EQ(summary["threads"], threads);
    return summary["position"].dump();
  };
  EXPECT_EQ(positions(2), positions(1));
}

TEST(FailedRuns, StepLimitIsAnOutcome) {
  const TemporaryFolder folder;
  const Ended run = program("run chain --out out --set schedule.max_steps=10", folder.path());
  EXPECT_EQ(run.exit_code, 3);
  const Json summary = Json::parse(content(folder / "out/summary.json"));
  EXPECT_EQ(summary["outcome"], "step_limit");
  EXPECT_EQ(summary["work"]["steps"], 10);
}

TEST(FailedRuns, FolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  write(folder / "out", "a file in the way");
  const Ended run = program("run chain --out out", folder.path());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("out"), std::string::npos);
  EXPECT_EQ(content(folder / "out"), "a file in the way");
}

}  // namespace
}  // namespace jetlag::testing
