// SPDX-License-Identifier: MIT
#pragma once
// A scene: what is simulated, and how. Read from JSON, checked, and turned into a simulation.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jetlag/contact/contact_record.hpp"
#include "jetlag/ensembles/random_ensemble.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/output/deformation.hpp"
#include "jetlag/output/output_options.hpp"
#include "jetlag/output/shape.hpp"
#include "jetlag/schedule/schedule.hpp"
#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// A checked scene, ready to run.
struct Scene {
  std::string name;
  std::string json;  // the complete scene, defaults included, so that the run can be repeated
  std::shared_ptr<const System<double>> system;
  State<double> initial;
  Shape shape;  // what a picture shows
  std::vector<Solid> solids;
  Coordinates<double> rest;  // positions at rest of solids [m]; empty without any
  double until = 0;
  std::uint64_t seed = 1;
  std::vector<std::shared_ptr<ContactRecord>> contacts;  // of its contacts: the next run writes into them
  std::uint64_t max_steps = 0;
  int threads = 1;
  OutputOptions output;
  std::vector<std::string> warnings;  // of what was read: it can be run, but may not be what was meant

  /// A new schedule with its integrator and control, before its first update.
  std::function<std::unique_ptr<Schedule>()> schedule;

  /// What taylor and random_taylor are made of; nothing for other integrators.
  std::optional<SeriesMethod> series;

  /// For `check`: the step, when it is the same every time, and the orders of the forces that a step computes on
  /// average; of a sequential law, whose degrees depend on the motion, a lower bound.
  std::optional<double> fixed_step;
  double mean_orders = 0;
  bool orders_at_least = false;
};

/// A scene from JSON text. source: what to call it in messages. folder: where relative mesh files are looked for.
/// Throws SceneError.
Scene read_scene(std::string_view json, const std::string& source, const std::filesystem::path& folder);

/// The name that stands for a scene from standard input.
inline constexpr std::string_view standard_input = "-";

/// A scene by built-in name, from a file, a pipe or standard input, with values replaced: "key.path=value", value in JSON
/// or a plain word. A named pipe that nobody opens for writing within a second is refused.
/// Throws SceneError.
Scene load_scene(const std::string& name_or_file, const std::vector<std::string>& settings = {},
                 std::optional<std::uint64_t> seed = std::nullopt);

/// The scenes that come with the program.
struct BuiltInScene {
  std::string name;
  std::string description;  // one line
  std::string json;
};
const std::vector<BuiltInScene>& built_in_scenes();

}  // namespace jetlag
