// SPDX-License-Identifier: MIT
// `jetlag ensemble` as users run it, and what its statistics are.
#include "jetlag/runs/run_ensemble.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "jetlag/pictures/pictures.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A mass between two walls by springs of rest length 0 that pull as k x each: x'' = -2 k x, k = 1/2.
const char* const oscillator = R"({
  "name": "oscillator", "dimension": 1,
  "particles": {"position": [[-1], [0.25], [1]], "velocity": [[0], [0], [0]], "mass": 1, "fixed": [0, 2]},
  "forces": [{"type": "spring", "pairs": [[0, 1], [1, 2]], "stiffness": 0.5, "rest_length": 0.5}],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.5},
  "control": {"type": "fixed", "step": 0.5},
  "until": 5.0, "seed": 3, "output": {"frames": 10, "energy": true, "pictures": false}
})";

Scene scene_with(const std::string& name, const Json& replaced = Json::object()) {
  Json json = Json::parse(oscillator);
  json.merge_patch(replaced);
  return read_scene(json.dump(), name, ".");
}

/// x'' = -x in steps of 3: what degree 4 leaves out, 3^6/6!, is as large as the motion.
TEST(EnsembleOfAScene, WarnsOfGivenStepsThatAreTooLong) {
  EnsembleOptions options;
  options.members = 40;
  const auto warning = [&](double step) {
    const EnsembleResult result =
        run_ensemble(scene_with("oscillator", {{"control", {{"step", step}}}, {"until", 30.0}}), options);
    const Json table = Json::parse(to_json(result))["deterministic"]["warning"];
    EXPECT_EQ(table.is_null() ? "" : table.get<std::string>(), result.warning);
    return result.warning;
  };
  EXPECT_THAT(warning(3.0), HasSubstr("cannot be shortened"));
  EXPECT_EQ(warning(0.05), "");
}

/// On a line, and as long as no end passes the other, the forces are linear: with u = x - i v one step is u -> R_K(i h) u,
///     E x_n = Re (T_N^n u_0),   E x_n^2 = ((E|R|^2)^n |u_0|^2 + Re (E R^2)^n u_0^2) / 2.   Source: methods 1d.
/// The sample variance of M members has a relative error of some sqrt((kurtosis - 1) / M); z < 4 with kurtosis <= 9.
TEST(EnsembleOfAScene, HasTheMeanAndTheSpreadOfTheory) {
  constexpr int members = 20000;
  EnsembleOptions options;
  options.members = members;
  const EnsembleResult result = run_ensemble(scene_with("oscillator"), options);
  ASSERT_EQ(result.outcome, Outcome::success);
  ASSERT_EQ(result.frames.size(), 11u);
  ASSERT_EQ(result.quantities.size(), 2u);  // x and the energy
  EXPECT_TRUE(result.in_lanes);

  using Complex = std::complex<double>;
  const auto law = geometric(3, 6, 0.5);
  const Complex z(0, 0.5);
  Complex term = 1, series = 0, mean = 0, square = 0;
  double size = 0;
  for (int k = 0; k <= 6; ++k) {
    if (k > 0) term *= z / double(k);
    series += law.weight(k) * term;
    const double p = law.at_least(k) - law.at_least(k + 1);
    mean += p * series;
    square += p * series * series;
    size += p * std::norm(series);
  }
  for (int n = 1; n <= 10; ++n) {
    const Sample& x = result.frames[n].samples[0];
    const double u = 0.25;
    const double expected = (std::pow(mean, n) * u).real();
    const double variance =
        (std::pow(size, n) + std::pow(square, n).real()) * u * u / 2 - expected * expected;
    EXPECT_LT(std::abs(x.mean - expected), 4 * std::sqrt(variance / members)) << n;
    EXPECT_NEAR(x.spread * x.spread / variance, 1, 4 * std::sqrt(8.0 / members)) << n;
    EXPECT_NEAR(result.frames[n].reference[0], 0.25 * std::cos(0.5 * n), 1e-13);
    EXPECT_LE(x.quantiles[0], x.quantiles[2]);
    EXPECT_LE(x.quantiles[2], x.quantiles[4]);

    const Calibration& c = result.frames[n].calibration;
    const double of_mean = x.mean - 0.25 * std::cos(0.5 * n);
    EXPECT_NEAR(c.mean_error, std::abs(of_mean), 1e-13);
    EXPECT_DOUBLE_EQ(c.spread, x.spread);
    EXPECT_NEAR(c.member_error, std::hypot(x.spread, of_mean), 1e-4 * x.spread);
    const Complex fixed = std::pow(1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0, n);
    EXPECT_NEAR(c.deterministic_error, std::abs(0.25 * (fixed.real() - std::cos(0.5 * n))), 1e-13);
  }
  EXPECT_EQ(result.deterministic_degree, 4);  // E K = 3 + 1/2 + 1/4 + 1/8
  EXPECT_EQ(result.work.steps, members * 10u);
}

/// Steps of 0.3 s and frames every 0.5 s, or three times as many: the same motion.
TEST(EnsembleOfAScene, DoesNotDependOnWhereOneLooks) {
  for (const bool shared_draw : {true, false}) {
    EnsembleOptions options;
    options.members = 40;
    const Json step = {{"control", {{"step", 0.3}}}, {"integrator", {{"shared_draw", shared_draw}}}};
    Json more = step;
    more["output"] = {{"frames", 30}};
    const EnsembleResult few = run_ensemble(scene_with("few", step), options),
                         many = run_ensemble(scene_with("many", more), options);
    EXPECT_EQ(few.work.steps, 40u * 17u);
    EXPECT_EQ(many.work.steps, few.work.steps);
    for (int f = 0; f <= 10; ++f) {
      EXPECT_EQ(few.frames[f].samples[0].mean, many.frames[3 * f].samples[0].mean);
      EXPECT_EQ(few.frames[f].samples[1].spread, many.frames[3 * f].samples[1].spread);
      EXPECT_EQ(few.frames[f].calibration.deterministic_error,
                many.frames[3 * f].calibration.deterministic_error);
    }
  }
}

TEST(EnsembleOfAScene, PerturbsInitialPositions) {
  EnsembleOptions options;
  options.members = 4000;
  options.perturbation = 0.01;
  const Json taylor = {{"integrator",
                        {{"type", "taylor"},
                         {"degree", 12},
                         {"min_degree", nullptr},
                         {"max_degree", nullptr},
                         {"probability", nullptr}}}};
  const EnsembleResult result = run_ensemble(scene_with("oscillator", taylor), options);
  // The spread follows the motion, cos t, and its sample value is right to 4 / sqrt(2 M).
  for (const EnsembleFrame& frame : result.frames)
    EXPECT_NEAR(frame.samples[0].spread, 0.01 * std::abs(std::cos(frame.time)), 0.01 * 4 / std::sqrt(8000.0));
  EXPECT_NEAR(result.frames[0].samples[0].mean, 0.25, 0.01 * 4 / std::sqrt(4000.0));
}

TEST(EnsembleOfAScene, DoesNotDependOnThreadsNorOnThePast) {
  const TemporaryFolder folder;
  write(folder / "scene.json", oscillator);
  for (const char* arguments : {"--threads 1 --out one", "--threads 4 --out four"})
    ASSERT_EQ(program("ensemble scene.json --members 100 --quiet " + std::string(arguments), folder.path())
                  .exit_code,
              0);
  EXPECT_EQ(content(folder / "one/ensemble.csv"), content(folder / "four/ensemble.csv"));
  ASSERT_EQ(program("ensemble scene.json --members 100 --seed 4 --quiet --out one", folder.path()).exit_code,
            0);
  EXPECT_NE(content(folder / "one/ensemble.csv"), content(folder / "four/ensemble.csv"));
}

TEST(EnsembleOfAScene, LeavesATableASummaryAndAPicture) {
  const TemporaryFolder folder;
  write(folder / "scene.json", oscillator);
  const Ended run = program(
      "ensemble scene.json --members 50 --watch 1.x --velocities --set output.pictures=true --set "
      "output.frames=5",
      folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto out = folder / "out/scene_ensemble";
  EXPECT_THAT(run.output, HasSubstr("50 of 50 members"));

  std::istringstream table(content(out / "ensemble.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "time,particle,quantity,mean,spread,q05,q25,q50,q75,q95,mean_low,mean_high,reference");
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    EXPECT_EQ(std::ranges::count(line, ','), 12) << line;
    const std::string name = rows % 3 == 0 ? ",1,x," : rows % 3 == 1 ? ",1,vx," : ",,energy,";
    EXPECT_THAT(line, HasSubstr(name));
  }
  EXPECT_EQ(rows, 6 * 3);

  const Json summary = Json::parse(content(out / "ensemble.json"));
  EXPECT_EQ(summary["outcome"], "success");
  EXPECT_EQ(summary["members"], 50);
  EXPECT_EQ(summary["failed"], 0);
  EXPECT_EQ(summary["time"], 5.0);
  EXPECT_EQ(summary["work"]["steps"], 50 * 10);
  EXPECT_EQ(summary["calibration"].size(), 6u);
  EXPECT_TRUE(summary["calibration"][0]["spread_over_mean_error"].is_null());  // nothing has moved yet
  EXPECT_GT(summary["calibration"][5]["spread_over_mean_error"], 1.0);
  for (const auto& [key, value] : summary["over_time"].items()) EXPECT_TRUE(value.is_number()) << key;
  for (const char* key :
       {"wall_seconds", "version", "instruction_set", "threads", "seed", "layout", "definitions"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_TRUE(std::filesystem::exists(out / "scene.json"));
  if (can_draw()) {
    const std::string picture = content(out / "ensemble.svg");
    for (const char* text :
         {"oscillator: 50 members", "x of particle 1", "reference", "5 to 95", "spread", "time [s]"})
      EXPECT_THAT(picture, HasSubstr(text));
  }
}

/// Degree 3 and a step of twice the stability limit: every member grows beyond all numbers.
TEST(EnsembleOfAScene, SaysWhenAllMembersFail) {
  const TemporaryFolder folder;
  write(folder / "scene.json", oscillator);
  const Ended run =
      program("ensemble scene.json --members 20 --set forces[0].stiffness=1e9 --set until=100 --out out",
              folder.path());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  EXPECT_THAT(run.output, HasSubstr("all members have failed"));
  const Json summary = Json::parse(content(folder / "out/ensemble.json"));
  EXPECT_EQ(summary["outcome"], "non_finite");
  EXPECT_EQ(summary["failed"], 20);
  EXPECT_EQ(summary["failures"].size(), 10u);
  EXPECT_LT(summary["time"], 100.0);
}

TEST(EnsembleOfAScene, EndsInGoodOrderWhereItIsAsked) {
  int frames = 0;
  EnsembleHooks hooks;
  hooks.go_on = [&] { return frames < 3; };
  hooks.after_frame = [&](double, double) { ++frames; };
  EnsembleOptions options;
  options.members = 10;
  const EnsembleResult result = run_ensemble(scene_with("oscillator"), options, hooks);
  EXPECT_EQ(result.outcome, Outcome::interrupted);
  EXPECT_EQ(result.frames.size(), 4u);
  EXPECT_EQ(result.frames.back().time, 1.5);
}

TEST(EnsembleOfAScene, ComparesNoSpreadOfStartsWithAFixedDegree) {  // neither in the file nor on the terminal
  const TemporaryFolder folder;
  write(folder / "scene.json", oscillator);
  for (const bool perturbed : {false, true}) {
    const Ended run = program(
        "ensemble scene.json --members 10 --out out" + std::string(perturbed ? " --perturb 1e-3" : ""),
        folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    const Json summary = Json::parse(content(folder / "out/ensemble.json"));
    EXPECT_EQ(summary["over_time"]["spread_over_deterministic_error"].is_null(), perturbed);
    const std::string row = run.output.substr(run.output.find("true error of fixed degree"));
    EXPECT_EQ(row.substr(0, row.find('\n')).find("spread / it") == std::string::npos, perturbed)
        << run.output;
  }
}

TEST(EnsembleOfAScene, RefusesBadInputAndWritesNothing) {
  const TemporaryFolder folder;
  write(folder / "scene.json", oscillator);
  const std::pair<const char*, std::vector<const char*>> cases[] = {
      {"--members 0", {"--members", "got 0", "1 to 1000000"}},
      {"--members many", {"--members", "many"}},
      {"--threads 0", {"--threads", "got 0", "1 to 1024"}},
      {"--perturb -1", {"--perturb", "got -1", ">= 0"}},
      {"--watch 0", {"--watch", "got 0", "fixed"}},
      {"--watch 7", {"--watch", "got 7", "0 to 2"}},
      {"--watch 1.y", {"--watch", "got 1.y", "component of x"}},
      {"--watch top", {"--watch", "got top"}},
      {"--seed -1", {"--seed", "-1"}},
      {"--set integrator.max_degree=3", {"integrator", "the same", "--perturb"}},
      {"--set 'integrator={\"type\": \"leapfrog\"}'", {"integrator.type", "random_taylor"}},
      {"--set particles.fixed=[0,1,2]", {"particles.fixed", "moves"}}};
  for (const auto& [arguments, says] : cases) {
    const Ended run = program("ensemble scene.json --out out " + std::string(arguments), folder.path());
    EXPECT_EQ(run.exit_code, 2) << arguments << run.output;
    for (const char* what : says) EXPECT_THAT(run.output, HasSubstr(what)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  }
}

}  // namespace
}  // namespace jetlag::testing
