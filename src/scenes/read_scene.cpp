// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/element_blocks.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

OutputOptions read_output(const Value& output) {
  std::vector<std::string_view> keys = {"frames"};
  for (const OutputKey& key : output_keys) keys.push_back(key.name);
  output.only(keys);
  OutputOptions options;
  options.frames = static_cast<int>(output.at("frames", options.frames).integer(1, 1'000'000));
  for (const auto& [name, asked] : output_keys) options.*asked = output.at(name, options.*asked).boolean();
  return options;
}

/// The axis nearest to the way up: against the uniform fields, or out of the first floor, or else the second.
std::array<int, 3> up_of(const System<double>& system) {
  std::array<double, 3> up{};
  for (const auto& group : system.elements())
    if (group.law.name == UniformField::name && group.count() > 0)
      for (int c = 0; c < 3; ++c) up[c] -= group.parameters[c];
  const auto floor = std::ranges::find_if(system.elements(), [](const Elements<double>& group) {
    return (group.law.name == Floor::name || group.law.name == QuadraticFloor::name) && group.count() > 0;
  });
  if (up == std::array{0.0, 0.0, 0.0} && floor != system.elements().end())
    std::copy_n(floor->parameters.begin() + 2, 3, up.begin());  // after stiffness and height
  int axis = 1;
  for (int c = 0; c < 3; ++c)
    if (std::abs(up[c]) > std::abs(up[axis])) axis = c;
  std::array<int, 3> nearest{};
  nearest[axis] = up[axis] < 0 ? -1 : 1;
  return nearest;
}

Shape shape_of(const Particles& particles, std::vector<std::array<int, 2>> lines) {
  Shape shape;
  shape.dimension = particles.dimension;
  shape.particles = static_cast<int>(particles.mass.size());
  shape.lines = std::move(lines);
  shape.tetrahedra = particles.mesh.tetrahedra;
  shape.surface = shape.tetrahedra.empty() ? particles.mesh.triangles
                                           : boundary(shape.tetrahedra, particles.state.position);
  for (std::size_t i = 0; i < particles.fixed.size(); ++i)
    if (particles.fixed[i]) shape.fixed.push_back(static_cast<int>(i));
  return shape;
}

/// Refuses numbers that are too large together, such as a mass and the square of its velocity.
void require_energy(const System<double>& system, const State<double>& initial, const Value& particles) {
  if (std::isfinite(EnergyMeter(system)(initial).total()) && momentum(system, initial).allFinite()) return;
  throw SceneError(particles.path() +
                   ": their energy or momentum at the beginning is not finite; must be smaller masses, "
                   "velocities, distances or strengths of forces");
}

/// Refuses a scene whose series would not fit into the memory of this machine.
void require_memory(const System<double>& system, int degree, const Value& particles) {
  double numbers = 0;
  for (const auto& elements : system.elements()) {
    const Program program(elements.law.force);
    numbers += static_cast<double>(elements.count()) * (program.histories * (degree + 1) + program.statics);
  }
  numbers += 2.0 * system.particles() * padded(system.dimension()) * (degree + 2);
  const double bytes = 8 * numbers;
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes > 0.8 * memory)
    throw SceneError(particles.path() + ": the series of this scene would take " +
                     std::to_string(bytes / 1e9) + " GB; must be below 80 % of the memory of this machine, " +
                     std::to_string(memory / 1e9) +
                     " GB; take fewer particles, fewer forces or a smaller degree");
}

Scene read(Json json, const std::filesystem::path& folder) {
  const Value value(json, "");
  value.only({"name", "dimension", "particles", "forces", "integrator", "control", "schedule", "until",
              "seed", "output"});
  Scene scene;
  scene.name = value.at("name", "scene").text();
  scene.seed = value.at("seed", 1).seed();
  scene.until = value.at("until").number(positive);
  scene.output = read_output(value.at("output", Json::object()));
  const auto dimension = static_cast<int>(value.at("dimension", 3).integer(1, 3));
  Particles particles = read_particles(value.at("particles"), dimension, scene.seed, folder);

  auto system = std::make_shared<System<double>>(dimension, particles.mass);
  for (std::size_t i = 0; i < particles.fixed.size(); ++i)
    if (particles.fixed[i]) system->fix(static_cast<int>(i));
  auto lines = read_forces(value.at("forces", Json::array()), particles, *system);
  Method method = read_method(value, system, scene.seed);

  require_energy(*system, particles.state, value.at("particles"));
  require_memory(*system, static_cast<int>(method.largest_degree), value.at("particles"));
  scene.shape = shape_of(particles, std::move(lines));
  scene.shape.up = up_of(*system);
  scene.initial = std::move(particles.state);
  scene.system = std::move(system);
  scene.schedule = std::move(method.schedule);
  scene.series = std::move(method.series);
  scene.max_steps = method.max_steps;
  scene.threads = method.threads;
  scene.fixed_step = method.fixed_step;
  scene.mean_orders = method.mean_orders;
  scene.orders_at_least = method.at_least;
  scene.json = json.dump(2);
  return scene;
}

/// A path such as forces[1].stiffness[3] in steps: keys and positions. A step may be empty, as in "control..step".
std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.' || c == '[')
      steps.emplace_back();
    else if (c != ']')
      steps.back() += c;
  }
  return steps;
}

/// "key.path=value" put into the scene.
void apply_setting(Json& json, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    throw SceneError("--set " + setting + ": must be key.path=value, such as control.step=0.01");
  const std::string path = setting.substr(0, equals), text = setting.substr(equals + 1);
  const auto steps = steps_of(path);
  if (steps.size() > 16)
    throw SceneError("--set " + setting.substr(0, 60) + ": must be a path of 1 to 16 steps");
  if (std::ranges::count(steps, "") > 0)
    throw SceneError("--set " + setting.substr(0, 60) +
                     ": a part of its path is empty; must be key.path=value, such as control.step=0.01");
  Json* at = &json;
  std::string so_far;
  for (const std::string& step : steps) {
    if (at->is_array()) {
      const bool digits =
          !step.empty() && step.size() < 10 && step.find_first_not_of("0123456789") == std::string::npos;
      const std::size_t i = digits ? std::stoul(step) : at->size();
      if (i >= at->size())
        throw SceneError("--set " + path + ": got [" + step + "]; must be a position below " +
                         std::to_string(at->size()));
      at = &(*at)[i];
    } else if (at->is_object() || at->is_null()) {
      at = &(*at)[step];
    } else {
      throw SceneError("--set " + path + ": " + so_far + " is " + at->dump() +
                       ", which has no parts; replace it as a whole");
    }
    so_far += (so_far.empty() ? "" : ".") + step;
  }
  *at = Json::accept(text) ? parse_json(text, "--set " + path) : Json(text);
}

}  // namespace

Scene read_scene(std::string_view json, const std::string& source, const std::filesystem::path& folder) {
  return read(parse_json(json, source), folder);
}

Scene load_scene(const std::string& name_or_file, const std::vector<std::string>& settings,
                 std::optional<std::uint64_t> seed) {
  Json json;
  std::filesystem::path folder = std::filesystem::current_path();
  const auto& scenes = built_in_scenes();
  const auto built_in = std::ranges::find(scenes, name_or_file, &BuiltInScene::name);
  if (built_in != scenes.end()) {
    json = parse_json(built_in->json, name_or_file);
  } else {
    std::string names;
    for (const auto& scene : scenes) names += (names.empty() ? "" : ", ") + scene.name;
    std::ifstream file(name_or_file, std::ios::binary);
    if (!std::filesystem::is_regular_file(name_or_file) || !file)
      throw SceneError("scene: got \"" + name_or_file + "\"; must be one of " + names +
                       ", or a JSON file that can be read");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    json = parse_json(text, name_or_file);
    folder = std::filesystem::absolute(name_or_file).parent_path();
  }
  if (!json.is_object()) throw SceneError("(the whole scene): must be a JSON object");
  for (const std::string& setting : settings) apply_setting(json, setting);
  if (seed) json["seed"] = *seed;
  try {
    json.dump();
  } catch (const Json::exception&) {
    throw SceneError("--set: keys and texts must be valid UTF-8");
  }
  return read(std::move(json), folder);
}

}  // namespace jetlag
