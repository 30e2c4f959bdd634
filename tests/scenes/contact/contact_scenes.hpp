// SPDX-License-Identifier: MIT
#pragma once
// Scenes with contact, for tests: parts in JSON.

#include <string>

#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing::contact_scenes {

/// By Taylor's method of degree 12 to 1e-9 m a step, unless `more` says otherwise; more: other members of the scene.
inline std::string text(int dimension, const std::string& particles, const std::string& forces,
                        const std::string& more = "") {
  const std::string method = more.find("\"integrator\"") != std::string::npos
                                 ? ""
                                 : R"(, "integrator": {"type": "taylor", "degree": 12},
    "control": {"type": "last_two", "tolerance": 1e-9})";
  return R"({"dimension": )" + std::to_string(dimension) + R"(, "particles": )" + particles +
         R"(, "forces": [)" + forces + R"(], "until": 1, "output": {"frames": 10, "pictures": false})" +
         method + (more.empty() ? "" : ", " + more) + "}";
}

inline Scene scene(int dimension, const std::string& particles, const std::string& forces,
                   const std::string& more = "") {
  return read_scene(text(dimension, particles, forces, more), "test", ".");
}

/// A contact of thickness 0.1 m and 1000 N/m, with more keys.
inline std::string barrier(const std::string& more = "") {
  return R"({"type": "contact_barrier", "thickness": 0.1, "stiffness": 1000)" +
         (more.empty() ? "" : ", " + more) + "}";
}

}  // namespace jetlag::testing::contact_scenes
