// SPDX-License-Identifier: MIT
// What an ensemble costs: the fixed degree it is compared with, what `check` foretells, memory.
#include <gmock/gmock.h>
#include <malloc.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "jetlag/runs/run_ensemble.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A net of springs in a plane, held at its upper edge; too many elements for lanes.
const char* const net = R"({
  "name": "net", "dimension": 2,
  "particles": {"grid": [8, 8], "spacing": 0.1, "mass": 1, "springs": "cloth", "fixed": [0, 7]},
  "forces": [{"type": "spring", "pairs": "edges", "stiffness": 50, "rest_length": "initial"},
             {"type": "drag", "coefficient": 0.1}, {"type": "uniform_field", "acceleration": [0, -9.8]}],
  "integrator": {"type": "random_taylor", "law": "geometric", "min_degree": 3, "max_degree": 9, "probability": 0.5,
                 "shared_draw": false},
  "control": {"type": "fixed", "step": 0.004},
  "until": 0.08, "seed": 3, "output": {"frames": 4, "energy": false, "pictures": false}
})";

std::string net_with(const Json& replaced) {
  Json json = Json::parse(net);
  json.merge_patch(replaced);
  return json.dump();
}
EnsembleResult result_of(const std::string& scene, int members) {
  EnsembleOptions options;
  options.members = members;
  return run_ensemble(read_scene(scene, "net", "."), options);
}

const Json shared = {{"integrator", {{"shared_draw", true}}}};
const Json derivative = {{"integrator", {{"velocity", "derivative"}}}};
const Json stratified = {{"integrator", {{"draws", "stratified"}}}};
const Json sequential = {
    {"integrator",
     {{"law", "sequential"}, {"probability", nullptr}, {"target", 1e-9}, {"shared_draw", true}}}};
const Json jorba_zou = {{"integrator", {{"shared_draw", true}}},
                        {"control", {{"type", "jorba_zou"}, {"step", nullptr}}}};

/// The fixed degree costs, step by step, what the members cost, to half an order.
TEST(CostOfAnEnsemble, IsThatOfTheFixedDegreeBesideIt) {
  for (const Json& change : {Json::object(), shared, derivative, stratified, sequential, jorba_zou}) {
    const EnsembleResult result = result_of(net_with(change), 12);
    ASSERT_EQ(result.outcome, Outcome::success);
    ASSERT_FALSE(result.in_lanes);
    const auto orders = [](const Work& work) {  // one coefficient of each moving particle for an order
      return double(work.coefficients) / double(work.updates);
    };
    EXPECT_NEAR(orders(result.deterministic_work), orders(result.work), 0.5 + 1e-9) << change;
    EXPECT_DOUBLE_EQ(result.mean_orders, orders(result.work)) << change;
    EXPECT_EQ(result.deterministic_message, "");
    EXPECT_GT(result.frames.back().calibration.deterministic_error, 0.0);
  }
}

/// What `check` says is what a run measures. The mean of 40 12 steps of degrees from 3 to 9, sd < 1.5, is right to
/// 4 1.5 / sqrt 480 = 0.28. Of a sequential law it says the least.
TEST(CostOfAnEnsemble, IsForetoldByCheck) {
  const TemporaryFolder folder;
  const auto foretold = [&](const Json& change) {
    write(folder / "net.json", net_with(change));
    const std::string said = program("check net.json", folder.path()).output;
    const auto at = said.find("a step      ");
    EXPECT_NE(at, std::string::npos) << said;
    return said.substr(at + 12, said.find('\n', at) - at - 12);
  };
  for (const Json& change : {Json::object(), shared, derivative, stratified, jorba_zou}) {
    Json longer = change;
    longer["until"] = 0.16;
    const double measured = result_of(net_with(longer), 12).mean_orders;
    EXPECT_NEAR(std::stod(foretold(change)), measured, 0.28) << change;
    EXPECT_THAT(foretold(change), HasSubstr("about"));
  }
  EXPECT_THAT(foretold(sequential), HasSubstr("at least 3"));
  EXPECT_LT(std::stod(foretold(sequential).substr(9)), result_of(net_with(sequential), 12).mean_orders);
}

/// No less is foretold than what the heap holds at the last frame, and at most 1.3 times that: 3.5 states for 3, for
/// fragments, and 600 bytes for what else a member has. Only the heap of the C library can be asked.
TEST(CostOfAnEnsemble, IsForetoldInMemory) {
  const auto in_use = [] {
    const auto heap = mallinfo2();
    return double(heap.uordblks) + double(heap.hblkhd);
  };
  if (in_use() == 0) GTEST_SKIP() << "another heap";
  for (const bool velocities : {false, true}) {
    const Scene scene = read_scene(net_with({{"until", 0.004}, {"output", {{"frames", 1}}}}), "net", ".");
    const auto measure = [&](int members) {
      EnsembleOptions options;
      options.members = members;
      options.velocities = velocities;
      double most = 0;
      EnsembleHooks hooks;
      hooks.after_frame = [&](double, double) { most = in_use(); };
      const double before = in_use();
      run_ensemble(scene, options, hooks);
      return std::pair(most - before, bytes_needed(scene, options));
    };
    const auto [few, few_foretold] = measure(100);
    const auto [many, many_foretold] = measure(2100);
    EXPECT_GT((many_foretold - few_foretold) / (many - few), 1.0) << velocities;
    EXPECT_LT((many_foretold - few_foretold) / (many - few), 1.3) << velocities;
  }
}

/// The paper's ellipse: 273 particles in a plane, some 31 GB for a million members.
TEST(CostOfAnEnsemble, IsRefusedWhereItExceedsTheMemory) {
  EnsembleOptions options;
  options.members = 1'000'000;
  EXPECT_GT(bytes_needed(load_scene("ellipse"), options), 24e9);
  const TemporaryFolder folder;
  const Ended run = program(
      "ensemble ellipse --members 1000000 --set particles.ellipse.cells=[200,120] --out out", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("--members: 1000000 members and 100 frames would take"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// Members that start apart spread by where they start: that is no error bar of a method.
TEST(CostOfAnEnsemble, IsNotComparedWhereMembersStartApart) {
  for (const double perturbation : {0.0, 0.001}) {
    EnsembleOptions options;
    options.members = 5;
    options.perturbation = perturbation;
    const Json said = Json::parse(to_json(run_ensemble(read_scene(net, "net", "."), options)));
    const char* ratio = "spread_over_deterministic_error";
    EXPECT_EQ(said["over_time"][ratio].is_null(), perturbation > 0);
    EXPECT_EQ(said["calibration"].back()[ratio].is_null(), perturbation > 0);
    EXPECT_EQ(said["definitions"][ratio].get<std::string>().starts_with("null"), perturbation > 0);
    EXPECT_TRUE(said["over_time"]["deterministic_error"].is_number());
  }
}

/// The program with another PATH.
Ended program_with_path(const std::string& path, const std::string& arguments,
                        const TemporaryFolder& folder) {
  const std::string before = getenv("PATH");
  setenv("PATH", path.c_str(), 1);
  FILE* pipe = popen(
      ("cd " + quoted(folder.path()) + " && exec '" JETLAG_PROGRAM "' " + arguments + " 2>&1").c_str(), "r");
  std::string output;
  for (int c; (c = fgetc(pipe)) != EOF;) output += static_cast<char>(c);
  const int status = pclose(pipe);
  setenv("PATH", before.c_str(), 1);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output};
}

/// A gnuplot that fails, and none: the numbers are there, and a warning.
TEST(EnsembleOfAScene, GoesOnWherePicturesCannotBeDrawn) {
  const TemporaryFolder folder;
  const std::filesystem::path bin = folder / "bin";
  write(folder / "scene.json", net_with({{"output", {{"pictures", true}}}}));
  std::filesystem::create_directory(bin);
  for (const bool there : {false, true}) {
    if (there) {
      write(bin / "gnuplot", "#!/bin/sh\necho no terminal >&2\nexit 1\n");
      std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
    }
    const Ended run =
        program_with_path(bin.string(), "ensemble scene.json --members 3 --quiet --out out", folder);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr(there ? "no terminal" : "gnuplot is not installed"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/ensemble.json"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/ensemble.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/ensemble.svg"));
  }
}

}  // namespace
}  // namespace jetlag::testing
