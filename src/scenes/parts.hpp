// SPDX-License-Identifier: MIT
#pragma once
// The parts of a scene file, each read by a file of its own.

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "jetlag/integrators/implicit/implicit_subcycling.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/scenes/scene.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "scenes/reader.hpp"

namespace jetlag {

struct Particles {
  int dimension;
  State<double> state;
  std::vector<double> mass;
  std::vector<bool> fixed;
  Mesh mesh;  // without vertices and cells where positions were listed
};

/// "particles": listed, or made by a generator.
Particles read_particles(const Value& particles, int dimension, std::uint64_t seed,
                         const std::filesystem::path& folder);

/// "forces": adds the elements of each to the system. Returns the pairs to draw.
std::vector<std::array<int, 2>> read_forces(const Value& forces, const Particles& particles,
                                            System<double>& system);

inline constexpr int largest_degree = 256;

/// "law" of random_taylor with its keys, and "draws" for it. Refuses keys of other laws.
Truncation read_truncation(const Value& integrator);
Draw read_draws(const Value& integrator, const Truncation& law, bool shared_draw, int particles);

/// "control", for a law of its integrator.
std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law, VelocitySeries velocity,
                                      const System<double>& system);
/// Whether it is "fixed". Refuses a type that does not exist.
bool is_fixed(const Value& control);
/// "max_step" [s], infinite where it is left out.
double read_max_step(const Value& control);
/// The fraction of the Courant limit, if asked for, and the fastest frequency it refers to.
std::optional<std::pair<double, double>> read_courant(const Value& control, const System<double>& system);

/// "integrator", "control" and "schedule" together.
struct Method {
  std::function<std::unique_ptr<Schedule>()> schedule;
  std::optional<SeriesMethod> series;
  std::uint64_t max_steps;
  int threads;
  std::optional<double> fixed_step;
  double mean_orders;
  int largest_degree;
  bool at_least = false;  // mean_orders is a lower bound
};
Method read_method(const Value& scene, std::shared_ptr<const System<double>> system, std::uint64_t seed);
/// The types of integrators and of schedules that exist; each but `lockstep` has a page in a method_register_*.cpp.
std::vector<std::string> integrator_types();
std::vector<std::string> schedule_types();

/// The same where the schedule has a clock for each particle: "control" may be left out.
Method read_clocks(const Value& scene, const Value& schedule, std::shared_ptr<const System<double>> system,
                   std::uint64_t seed);

/// The same for {"type": "avi"}, which has a clock for each element, and "subcycling", which has one for each step.
Method read_avi(const Value& scene, std::shared_ptr<const System<double>> system);
Method read_subcycling(const Value& scene, std::shared_ptr<const System<double>> system);

/// What such methods have in common: "schedule", which is asynchronous (returns max_steps); "control", which is fixed,
/// with a step, a fraction courant, or both; and what follows.
std::uint64_t read_own_schedule(const Value& scene);
Value read_own_control(const Value& scene);
Method impulse_method(std::function<std::unique_ptr<Schedule>()> make, std::uint64_t max_steps);

/// A list of particles: at least one, none fixed, none twice. Shape (particles).
std::vector<bool> read_partition(const Value& list, const System<double>& system);

/// "implicit" of explicit_implicit with steps `step` [s]: a list of particles or "courant". Shape (particles).
std::vector<bool> read_implicit_particles(const Value& integrator, const System<double>& system, double step);

/// The same for {"type": "qss1"}, "qss2" and "qss3", which have a clock for each component of the state.
Method read_qss(const Value& scene, std::shared_ptr<const System<double>> system);

/// "coarse" and "ratio" of {"type": "implicit_subcycling"}.
ImplicitSubcycling::Options read_implicit_subcycling(const Value& integrator, double step,
                                                     const System<double>& system);

/// Runs f; a std::invalid_argument becomes a SceneError about `value`.
template <class F>
auto checked(const Value& value, F f) {
  try {
    return f();
  } catch (const std::invalid_argument& error) {
    value.refuse(std::string("such that it works: ") + error.what());
  }
}

/// The member of a register that "type" names.
template <class Readers>
const auto& chosen(const Value& value, const Readers& readers) {
  std::vector<std::string> types;
  for (const auto& reader : readers) types.push_back(reader.type);
  const std::string type = value.at("type").one_of(types);
  return *std::ranges::find(readers, type, [](const auto& reader) { return std::string(reader.type); });
}

}  // namespace jetlag
