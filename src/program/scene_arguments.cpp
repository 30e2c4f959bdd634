// SPDX-License-Identifier: MIT
#include "program/scene_arguments.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "jetlag/scenes/error.hpp"

namespace jetlag {

std::vector<Option> SceneArguments::options(std::vector<Option> more) {
  std::vector<Option> all = {{.name = "scene",
                              .target = &scene,
                              .what = "a built-in scene, a JSON file, or -: standard input",
                              .required = true},
                             {.name = "--set",
                              .target = &settings,
                              .what = "replace a value: key.path=value, may be repeated",
                              .once_each = true},
                             {"--seed", &seed, "seed of the random numbers"}};
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return all;
}

Scene SceneArguments::load() const {
  if (seed.empty()) return load_scene(scene, settings);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), number);
  if (error != std::errc() || end != seed.data() + seed.size())
    throw SceneError("--seed: got " + seed + "; must be a whole number from 0 to 18446744073709551615");
  return load_scene(scene, settings, number);
}

std::string SceneArguments::stem() const {
  return scene == standard_input ? "stdin" : std::filesystem::path(scene).stem().string();
}

}  // namespace jetlag
