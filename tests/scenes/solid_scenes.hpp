// SPDX-License-Identifier: MIT
#pragma once
// Small scenes of solids.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing::solid_scenes {

using Json = nlohmann::ordered_json;

inline Scene scene(const Json& particles, const std::vector<Json>& forces, int dimension = 3) {
  const Json whole = {{"dimension", dimension},
                      {"particles", particles},
                      {"forces", Json(forces)},
                      {"integrator", {{"type", "taylor"}, {"degree", 8}}},
                      {"control", {{"type", "fixed"}, {"step", 1e-3}}},
                      {"until", 0.01},
                      {"output", {{"frames", 1}, {"pictures", false}}}};
  return read_scene(whole.dump(), "test", ".");
}

inline Json box_of(const Json& lengths, const Json& cells, const Json& more = Json::object()) {
  Json particles = {{"box", {{"lengths", lengths}, {"cells", cells}}}};
  particles.update(more);
  return particles;
}

inline Json rubber(const std::string& type, const Json& more = Json::object()) {
  Json force = {{"type", type}, {"young", 1e5}, {"poisson", 0.3}};
  force.update(more);
  return force;
}

}  // namespace jetlag::testing::solid_scenes
