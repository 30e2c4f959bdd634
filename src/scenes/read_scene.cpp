// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jetlag/base/text.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/model/element_blocks.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/choices.hpp"
#include "scenes/parts.hpp"
#include "scenes/scene_text.hpp"

namespace jetlag {

namespace {

OutputOptions read_output(const Value& output) {
  output.only(allowed(scene_keys(), "output"));
  OutputOptions options;
  options.frames = static_cast<int>(output.at("frames", options.frames).integer(0, 1'000'000));
  for (const OutputKey& key : output_keys)
    options.*key.asked = output.at(key.name, options.*key.asked).boolean();
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

/// The cells are those of the mesh; without one, those that forces name.
Shape shape_of(const Particles& particles, Drawn& drawn) {
  Shape shape;
  shape.dimension = particles.dimension;
  shape.particles = static_cast<int>(particles.mass.size());
  shape.lines = std::move(drawn.lines);
  const bool has_cells = !particles.mesh.tetrahedra.empty() || !particles.mesh.triangles.empty();
  shape.tetrahedra = has_cells ? particles.mesh.tetrahedra : std::move(drawn.tetrahedra);
  const auto& sheets = has_cells ? particles.mesh.triangles : drawn.triangles;
  if (!shape.tetrahedra.empty()) shape.surface = boundary(shape.tetrahedra, particles.rest);
  shape.surface.insert(shape.surface.end(), sheets.begin(), sheets.end());
  for (std::size_t i = 0; i < particles.own; ++i)
    if (particles.fixed[i]) shape.fixed.push_back(static_cast<int>(i));
  shape.obstacles = shape.particles - static_cast<int>(particles.own);
  shape.walls = particles.obstacles.loose_edges();
  if (shape.surface.empty())
    shape.walls = particles.obstacles.edges();  // pictures of springs and points show edges
  shape.surface.insert(shape.surface.end(), particles.walls.begin(), particles.walls.end());
  return shape;
}

/// Names a field that swings more than once in some six given steps: no series sees it, and no look at forces need.
void warn_of_swings(const System<double>& system, double step, std::vector<std::string>& warnings) {
  for (const auto& group : system.elements())
    if (group.law.name == OscillatingField::name && group.count() > 0 && group.parameters[3] * step > 1)
      warnings.push_back("control.step: " + shown(step) +
                         " s are too long for an oscillating_field of frequency " +
                         shown(group.parameters[3] / (2 * std::numbers::pi)) +
                         " 1/s: positions will be off; take steps below a sixth of its period");
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
  numbers += 4.0 * system.particles() * padded(system.dimension()) * (degree + 2);
  const double bytes = 8 * numbers;
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes > 0.8 * memory)
    throw SceneError(particles.path() + ": the series of this scene would take " + shown(bytes / 1e9) +
                     " GB; must be below 80 % of the memory of this machine, " + shown(memory / 1e9) +
                     " GB; take fewer particles, fewer forces or a smaller degree");
}

Scene read(Document& document, const std::filesystem::path& folder) {
  const Value value = document.root();
  std::vector<std::string_view> keys;
  for (const SceneKey& key : scene_keys())
    if (key.key.find('.') == std::string::npos) keys.push_back(key.key);
  value.only(keys);
  Scene scene;
  scene.name = value.at("name", "scene").text();
  scene.seed = value.at("seed", 1).seed();
  scene.until = value.at("until").number(positive);
  scene.output = read_output(value.at("output", JsonText{"{}"}));
  const auto dimension = static_cast<int>(value.at("dimension", 3).integer(1, 3));
  Particles particles = read_particles(value.at("particles"), dimension, scene.seed, folder);
  if (const auto obstacles = value.find("obstacles")) read_obstacles(*obstacles, folder, particles);
  scene.warnings = particles.mesh.warnings;

  auto system = std::make_shared<System<double>>(dimension, particles.mass);
  for (std::size_t i = 0; i < particles.fixed.size(); ++i)
    if (particles.fixed[i]) system->fix(static_cast<int>(i));
  ForcesFound forces = read_forces(value.at("forces", JsonText{"[]"}), particles, *system);
  scene.warnings.insert(scene.warnings.end(), forces.warnings.begin(), forces.warnings.end());
  scene.contacts = std::move(forces.contacts);
  Method method = read_method(value, system, particles.state, scene.seed);

  if (method.fixed_step) warn_of_swings(*system, *method.fixed_step, scene.warnings);
  require_memory(*system, static_cast<int>(method.largest_degree), value.at("particles"));
  require_energy(*system, particles.state, value.at("particles"));
  scene.shape = shape_of(particles, forces.drawn);
  scene.solids = std::move(forces.drawn.solids);
  if (!scene.solids.empty()) scene.rest = std::move(particles.rest);
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
  scene.json = document.text();
  return scene;
}

}  // namespace

Scene read_scene(std::string_view json, const std::string& source, const std::filesystem::path& folder) {
  Document document(json, source);
  return read(document, folder);
}

Scene load_scene(const std::string& name_or_file, const std::vector<std::string>& settings,
                 std::optional<std::uint64_t> seed) {
  std::string text;
  std::filesystem::path folder;
  const auto& scenes = built_in_scenes();
  const auto built_in = std::ranges::find(scenes, name_or_file, &BuiltInScene::name);
  if (built_in != scenes.end()) {
    text = built_in->json;
  } else {
    std::string names;
    for (const auto& scene : scenes) names += (names.empty() ? "" : ", ") + scene.name;
    text = scene_text(name_or_file, "one of " + names + ", -, or a JSON file that can be read");
    if (name_or_file != standard_input) folder = std::filesystem::path(name_or_file).parent_path();
  }
  Document document(text, name_or_file == standard_input ? "standard input" : name_or_file);
  if (!document.root().is_object()) throw SceneError("(the whole scene): must be a JSON object");
  for (const std::string& setting : settings) document.set(setting);
  if (seed) document.set("seed=" + std::to_string(*seed));
  document.text();  // refuses what is not UTF-8 before it is read
  return read(document, folder);
}

}  // namespace jetlag
