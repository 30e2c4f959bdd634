// SPDX-License-Identifier: MIT
// Every law and every draw runs from a scene file, and the scene a run leaves repeats it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

class TruncationScene : public ::testing::TestWithParam<const char*> {};

TEST_P(TruncationScene, RunsAndRepeatsItself) {
  const TemporaryFolder folder;
  auto scene = nlohmann::ordered_json::parse(R"({
    "dimension": 1,
    "particles": {"position": [[0], [1], [2.1]], "velocity": [[0], [0], [0.1]], "fixed": [0]},
    "forces": [{"type": "spring", "pairs": [[0, 1], [1, 2]], "stiffness": 5, "rest_length": 1.0}],
    "control": {"type": "fixed", "step": 0.05}, "until": 1, "output": {"frames": 2, "pictures": false}})");
  scene["integrator"] = nlohmann::ordered_json::parse(GetParam());
  scene["integrator"]["type"] = "random_taylor";
  write(folder / "scene.json", scene.dump());
  const Ended run = program("run scene.json --out out --quiet", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  ASSERT_EQ(program("run out/scene.json --out again --quiet", folder.path()).exit_code, 0);
  const auto position = [&](const char* summary) {
    return nlohmann::ordered_json::parse(content(folder / summary))["position"];
  };
  EXPECT_EQ(position("out/summary.json"), position("again/summary.json"));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, TruncationScene,
    ::testing::Values(
        R"({"min_degree": 3, "max_degree": 6, "base": 3, "draws": "ruler"})",
        R"({"law": "poisson", "min_degree": 3, "max_degree": 9, "mean": 1.5, "draws": "rotation"})",
        R"({"law": "tail", "tail": [1, 1, 1, 0.5, 0.25], "draws": "antithetic"})",
        R"({"law": "variance_capped", "terms": [1, 0.5, 0.1, 0.01, 0.001], "max_variance": 1e-5})",
        R"({"law": "sequential", "min_degree": 3, "max_degree": 9, "target": 1e-4, "shared_draw": false,
            "draws": "stratified"})",
        R"({"law": "single_term", "min_degree": 3, "max_degree": 6, "draws": "scrambled_ruler"})"));

}  // namespace
}  // namespace jetlag::testing
