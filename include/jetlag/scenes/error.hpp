// SPDX-License-Identifier: MIT
#pragma once
// What is wrong with a scene.

#include <stdexcept>
#include <string>

namespace jetlag {

/// Names the key, the value and what is allowed: "forces[1].stiffness[3]: got -5; must be a number > 0".
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace jetlag
