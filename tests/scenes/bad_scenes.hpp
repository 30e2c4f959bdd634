// SPDX-License-Identifier: MIT
#pragma once
// Scenes that are refused, each made of a good one by one change.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace jetlag::testing {

inline constexpr const char* good = R"({
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

struct BadScene {
  std::string name;
  std::string pointer;  // JSON pointer of what is replaced; "" with text: the whole file
  std::string value;    // JSON; "" removes
  std::string key;      // must be named in the message
  std::string says;     // must be in the message too: the value, or what is allowed
};

inline void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

inline std::string text_of(const BadScene& scene) {
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

}  // namespace jetlag::testing
