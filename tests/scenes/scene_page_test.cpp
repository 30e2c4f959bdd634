// SPDX-License-Identifier: MIT
// The page of scenes names everything that a scene may hold and that a run leaves, with the defaults that are read.
#include "scenes/scene_page.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "jetlag/output/summary.hpp"
#include "scenes/choices.hpp"

namespace jetlag::testing::scene_page_test {
namespace {

using jetlag::Json;  // with keys in their order
using ::testing::HasSubstr;

TEST(ScenePage, NamesEveryMemberOfEveryRegister) {
  const std::string page = scene_page();
  for (const auto& record : force_records()) EXPECT_THAT(page, HasSubstr("### `" + record.name + "`"));
  for (const auto& record : control_records()) EXPECT_THAT(page, HasSubstr("### `" + record.name + "`"));
  for (const auto& record : law_records()) EXPECT_THAT(page, HasSubstr("### `" + record.name + "`"));
  for (const auto& choice : particle_choices())
    EXPECT_THAT(page, HasSubstr("`particles." + choice.name + "`"));
  for (const auto& choice : obstacle_choices())
    EXPECT_THAT(page, HasSubstr("`obstacles[]." + choice.name + "`"));
}

TEST(ScenePage, NamesEveryKeyOfTheSummaryAndEveryOutcome) {
  const std::string page = scene_page();
  Summary failed;
  failed.outcome = Outcome::non_finite;
  failed.contact.emplace();
  const auto names = [&](const auto& self, const Json& object) -> void {
    for (const auto& [key, value] : object.items()) {
      EXPECT_THAT(page, HasSubstr("`" + key + "`"));
      if (value.is_object()) self(self, value);
    }
  };
  names(names, Json::parse(to_json(failed)));
  for (int i = 0; i <= static_cast<int>(Outcome::interrupted); ++i)
    EXPECT_THAT(page, HasSubstr("`" + std::string(to_string(static_cast<Outcome>(i))) + "`"));
}

/// The scene after it was read.
Json read(const Json& particles, const Json& forces) {
  const Json scene = {{"particles", particles},
                      {"forces", forces},
                      {"integrator", {{"type", "taylor"}, {"degree", 2}}},
                      {"control", {{"type", "fixed"}, {"step", 0.1}}},
                      {"until", 1}};
  return Json::parse(read_scene(scene.dump(), "test", ".").json);
}

/// Each default that is a value stands in the scene that was read.
void expect_defaults(const SceneKeys& keys, const Json& read) {
  for (const SceneKey& key : keys) {
    if (key.fallback.starts_with("none") || key.fallback.starts_with("required")) continue;
    const Json number = Json::parse(key.fallback, nullptr, false);
    const Json value = number.is_discarded() ? Json(key.fallback) : number;
    const Json& found = read.at(key.key);
    if (found.is_array())
      for (const Json& one : found) EXPECT_EQ(one, value) << key.key;
    else
      EXPECT_EQ(found, value) << key.key;
  }
}

TEST(ScenePage, HasTheDefaultsOfForces) {
  // A tetrahedron, and two triangles in a plane, which a membrane lies in: bending takes its rigidity.
  const Json corner = Json::parse(R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]],
                                      "tetrahedra": [[0, 1, 2, 3]], "triangles": [[0, 1, 2], [1, 4, 2]]})");
  const Json membrane = {{"type", "membrane"}, {"young", 1}, {"poisson", 0.25}, {"thickness", 1}};
  for (const ForceRecord& record : force_records()) {
    Json force = {{"type", record.name}};
    for (const SceneKey& key : record.keys)
      if (key.fallback.starts_with("required"))
        force[key.key] = key.key == "acceleration" || key.key == "stress" ? Json{0, 0, 1}
                         : key.key != "elements"                          ? Json(0.25)
                         : record.name == "angle"                         ? Json::parse("[[0, 1, 2]]")
                                                                          : Json::parse("[[0, 1, 2, 3]]");
    expect_defaults(record.keys, read(corner, Json::array({membrane, force})).at("forces").at(1));
  }
}

TEST(ScenePage, HasTheDefaultsOfParticlesAndOfTheScene) {
  const Json scene = read({{"grid", {2, 2}}, {"spacing", 1}}, Json::array());
  expect_defaults(named(particle_choices(), "grid").keys, scene.at("particles"));
  SceneKeys of_scene, of_output;
  for (SceneKey key : scene_keys()) {
    const bool output = key.key.starts_with("output.");
    if (output) key.key = key.key.substr(7);
    (output ? of_output : of_scene).push_back(key);
  }
  expect_defaults(of_scene, scene);
  expect_defaults(of_output, scene.at("output"));
}

}  // namespace
}  // namespace jetlag::testing::scene_page_test
