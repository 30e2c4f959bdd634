// SPDX-License-Identifier: MIT
#pragma once
// The body of the paper's runs.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace jetlag {

/// "particles" of a scene: masses of 1 kg on a Medit mesh, or where its name is empty on a generated body, at rest but for a
/// blow: all velocities normal with deviation 1 m/s.
inline nlohmann::ordered_json struck_body(const std::string& mesh) {
  nlohmann::ordered_json particles = {{"mass", 1.0}, {"velocity", {{"normal", 1.0}}}};
  if (mesh.empty()) {
    particles["ellipsoid"] = {{"radii", {0.8, 1.2, 0.8}}, {"cells", {8, 8}}, {"cut", {0.9, 0.95}}};
    particles["fix_below"] = 0.0;
  } else {
    particles["mesh"] = std::filesystem::absolute(mesh).string();
    particles["fix_below"] = 3.0;
  }
  return particles;
}

}  // namespace jetlag
