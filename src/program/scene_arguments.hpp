// SPDX-License-Identifier: MIT
#pragma once
// What the commands that take a scene have in common.

#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

struct SceneArguments {
  std::string scene;
  std::vector<std::string> settings;
  std::string seed;

  /// These, and `more`.
  std::vector<Option> options(std::vector<Option> more = {});
  /// Throws SceneError.
  Scene load() const;
  /// What results are called after where nothing else is said: the name of the scene without folder and ending.
  std::string stem() const;
};

}  // namespace jetlag
