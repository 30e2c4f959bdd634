// SPDX-License-Identifier: MIT
#include "jetlag/output/summary.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace jetlag::testing {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

Summary sample() {
  Summary summary;
  summary.time = 0.1 + 0.2;
  summary.position = Coordinates<double>{{1.0 / 3.0, -0.0}, {5e-324, 1e23}, {10.0, -7.0}};
  summary.velocity = -summary.position;
  summary.has_energy = true;
  summary.initial_energy = {1.0, 0.1};
  summary.final_energy = {1.0, 0.3};
  summary.max_relative_energy_error = 1.0 / 7.0;
  summary.initial_momentum = Eigen::Vector2d(0.1, 0.7);
  summary.final_momentum = Eigen::Vector2d(0.3, 1e-17);
  summary.work = {.steps = 3,
                  .updates = 4,
                  .coefficients = 20,
                  .element_coefficients = 18446744073709551615u,
                  .degrees = 18,
                  .rejected = 1,
                  .wake_ups = 2};
  summary.wall_seconds = 0.25;
  summary.version = "1.2.3";
  summary.seed = 18446744073709551615u;
  summary.instruction_set = "avx512";
  summary.threads = 2;
  return summary;
}

TEST(Summary, HasEveryKeyOfTheContractInItsOrder) {
  const Json json = Json::parse(to_json(sample()));
  EXPECT_THAT(keys(json), ElementsAre("outcome", "time", "position", "velocity", "energy", "momentum", "work",
                                      "elements", "frequency", "contact", "wall_seconds", "version", "seed",
                                      "instruction_set", "threads", "warnings"));
  EXPECT_THAT(keys(json["energy"]), ElementsAre("initial", "final", "max_relative_error"));
  EXPECT_THAT(keys(json["momentum"]), ElementsAre("initial", "final"));
  EXPECT_THAT(keys(json["work"]), ElementsAre("updates", "steps", "coefficients", "element_coefficients",
                                              "mean_degree", "rejected", "wake_ups"));
}

TEST(Summary, KeepsEveryDigit) {
  const Summary summary = sample();
  const Json json = Json::parse(to_json(summary));
  EXPECT_EQ(json["outcome"], "success");
  EXPECT_EQ(json["time"].get<double>(), summary.time);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index c = 0; c < 2; ++c) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(json["position"][i][c].get<double>()),
                std::bit_cast<std::uint64_t>(summary.position(i, c)));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(json["velocity"][i][c].get<double>()),
                std::bit_cast<std::uint64_t>(summary.velocity(i, c)));
    }
  EXPECT_EQ(json["energy"]["initial"].get<double>(), 1.0 + 0.1);
  EXPECT_EQ(json["energy"]["final"].get<double>(), 1.0 + 0.3);
  EXPECT_EQ(json["energy"]["max_relative_error"].get<double>(), 1.0 / 7.0);
  EXPECT_THAT(json["momentum"]["initial"].get<std::vector<double>>(), ElementsAre(0.1, 0.7));
  EXPECT_THAT(json["momentum"]["final"].get<std::vector<double>>(), ElementsAre(0.3, 1e-17));
  EXPECT_EQ(json["work"]["updates"], 4);
  EXPECT_EQ(json["work"]["steps"], 3);
  EXPECT_EQ(json["work"]["coefficients"], 20);
  EXPECT_EQ(json["work"]["element_coefficients"].get<std::uint64_t>(), 18446744073709551615u);
  EXPECT_EQ(json["work"]["mean_degree"].get<double>(), 4.5);
  EXPECT_EQ(json["work"]["rejected"], 1);
  EXPECT_EQ(json["work"]["wake_ups"], 2);
  EXPECT_EQ(json["wall_seconds"].get<double>(), 0.25);
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), 18446744073709551615u);
  EXPECT_EQ(json["instruction_set"], "avx512");
  EXPECT_EQ(json["threads"], 2);
}

TEST(Summary, SaysWhatACourantLimitStandsOn) {
  Summary summary = sample();
  EXPECT_EQ(Json::parse(to_json(summary))["frequency"], Json::object());
  summary.frequency = {.bound = 1.0 / 3.0, .refreshed = 7};
  EXPECT_EQ(Json::parse(to_json(summary))["frequency"],
            Json::parse(R"({"bound": 0.3333333333333333, "refreshed": 7})"));
}

TEST(Summary, SaysWhatContactsDid) {
  Summary summary = sample();
  EXPECT_EQ(Json::parse(to_json(summary))["contact"], Json::object());
  summary.contact = ContactRecord{.stencils_tested = 1,
                                  .crossings_tested = 2,
                                  .looks = 3,
                                  .active_largest = 4,
                                  .begun = 5,
                                  .ended = 6,
                                  .smallest_gap = {1.0 / 3.0, 0.5, {7, 8}}};
  EXPECT_EQ(Json::parse(to_json(summary))["contact"],
            Json::parse(R"({"stencils_tested": 1, "crossings_tested": 2, "looks": 3, "active_largest": 4,
      "contacts": {"begun": 5, "ended": 6},
      "smallest_gap": {"value": 0.3333333333333333, "time": 0.5, "particles": [7, 8]}})"));
  summary.contact = ContactRecord{};
  EXPECT_TRUE(Json::parse(to_json(summary))["contact"]["smallest_gap"]["value"].is_null());
}

TEST(Summary, SaysWhatWentWrong) {
  Summary summary = sample();
  EXPECT_FALSE(Json::parse(to_json(summary)).contains("message"));
  summary.outcome = Outcome::step_underflow;
  summary.message = "particles \"4\" and\n\\7\\ collide\xff";
  const Json json = Json::parse(to_json(summary));
  EXPECT_EQ(json["outcome"], "step_underflow");
  EXPECT_EQ(json["message"], "particles \"4\" and\n\\7\\ collide\ufffd");
}

TEST(Summary, ListsItsWarnings) {
  Summary summary = sample();
  EXPECT_EQ(Json::parse(to_json(summary))["warnings"], Json::array());
  summary.warnings = {"one", "\"two\""};
  EXPECT_EQ(Json::parse(to_json(summary))["warnings"], (std::vector<std::string>{"one", "\"two\""}));
}

TEST(Summary, IsNullWhereThereIsNoNumber) {
  Summary summary = sample();
  summary.has_energy = false;
  summary.position(0, 0) = std::numeric_limits<double>::quiet_NaN();
  summary.wall_seconds = std::numeric_limits<double>::infinity();
  const std::string text = to_json(summary);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["position"][0][0].is_null());
  EXPECT_TRUE(json["wall_seconds"].is_null());
  for (const auto& [name, value] : json["energy"].items()) EXPECT_TRUE(value.is_null()) << name;
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(Summary, OfNothingIsValid) {
  const Json json = Json::parse(to_json({}));
  EXPECT_TRUE(json["position"].empty());
  EXPECT_EQ(json["work"]["mean_degree"].get<double>(), 0.0);
}

}  // namespace
}  // namespace jetlag::testing
