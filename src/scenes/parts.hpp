// SPDX-License-Identifier: MIT
#pragma once
// The parts of a scene file, each read by a file of its own.

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "jetlag/contact/contact_record.hpp"
#include "jetlag/contact/surface.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/scenes/scene.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "scenes/keys.hpp"
#include "scenes/reader.hpp"

namespace jetlag {

struct Particles {
  int dimension;
  State<double> state;
  std::vector<double> mass;
  std::vector<bool> fixed;
  Mesh mesh;                          // without vertices and cells where positions were listed
  std::optional<double> thickness{};  // [m], of triangles by which masses were found
  Coordinates<double> rest;           // positions at rest [m], of elements whose parameters follow from them
  std::vector<int> grid{};            // counts along the axes, of a grid
  std::size_t own = 0;                // how many there are without the vertices of obstacles, which come last
  Surface obstacles{};                // of those vertices
  std::vector<std::array<int, 3>> walls{};  // its triangles, turning left when seen from outside
};

/// What pictures, frames and the summary show of forces.
struct Drawn {
  std::vector<Solid> solids;
  std::vector<std::array<int, 2>> lines;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 4>> tetrahedra;
};

/// Refuses the dimension of a scene unless it is from low to high: for this value. hint: what else to do.
inline void require_dimension(const Value& value, int dimension, int low, int high,
                              const std::string& hint = "") {
  if (low <= dimension && dimension <= high) return;
  throw SceneError("dimension: got " + std::to_string(dimension) + "; must be " +
                   (low < high ? std::to_string(low) + " or " : "") + std::to_string(high) + " for " +
                   value.path() + hint);
}

/// An element: a list of P different particles, 0 .. count-1.
template <std::size_t P>
std::array<int, P> read_members(const Value& element, Eigen::Index count) {
  static const std::string words[] = {"no", "one", "two", "three", "four"};
  if (!element.is_array() || element.size() != P) element.refuse(words[P] + " particles");
  std::array<int, P> members;
  for (std::size_t i = 0; i < P; ++i) {
    members[i] = static_cast<int>(element.at(i).integer(0, static_cast<std::int64_t>(count) - 1));
    if (std::find(members.begin(), members.begin() + i, members[i]) != members.begin() + i)
      element.refuse(words[P] + " different particles");
  }
  return members;
}

constexpr std::int64_t max_particles = 5'000'000;

/// The mesh in a file that a text names; the text becomes its whole path.
Mesh read_mesh_file(const Value& value, const std::filesystem::path& folder);

/// The mesh of "particles": of the generator `origin`; of "position" the cells of so many `listed` positions.
Mesh read_mesh(const std::string& origin, const Value& particles, Eigen::Index listed, int dimension,
               const std::filesystem::path& folder);

/// "particles": listed, or made by a generator.
Particles read_particles(const Value& particles, int dimension, std::uint64_t seed,
                         const std::filesystem::path& folder);

/// "obstacles": their vertices become particles that are fixed, after the others.
void read_obstacles(const Value& obstacles, const std::filesystem::path& folder, Particles& particles);

/// What forces bring to a scene beside their elements.
struct ForcesFound {
  Drawn drawn{};
  std::vector<std::string> warnings{};
  std::vector<std::shared_ptr<ContactRecord>> contacts{};
};

/// "forces": adds the elements of each to the system.
ForcesFound read_forces(const Value& forces, const Particles& particles, System<double>& system);

inline constexpr int largest_degree = 256;

/// "law" of random_taylor and "draws" for it; their keys, for its record.
Truncation read_truncation(const Value& integrator);
Draw read_draws(const Value& integrator, const Truncation& law, bool shared_draw, int particles);
SceneKeys truncation_keys();

/// "control" of a series, for a law of its integrator; the keys of all of them.
std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law, VelocitySeries velocity,
                                      const System<double>& system, const State<double>& start);
SceneKeys control_keys();
/// Refuses a control that reads the variance of a law which has none beforehand, as a coupled sum.
void require_control_for(const Truncation& law, const Value& control);
/// "max_step" [s], infinite where it is left out.
double read_max_step(const Value& control);
/// The fraction of the Courant limit, if asked for, and a bound of the fastest frequency at the start: of methods that know
/// no limit with a damping.
std::optional<std::pair<double, double>> read_courant(const Value& control, const System<double>& system,
                                                      const State<double>& start);
/// The fraction alone, of series with a law: refused where it leaves no step at the start, or does not limit it.
std::optional<double> read_courant_of_series(const Value& control, const System<double>& system,
                                             const State<double>& start, const TruncationLaw& law,
                                             VelocitySeries velocity);

/// A list of particles: at least one, none fixed, none twice. Shape (particles).
std::vector<bool> read_partition(const Value& list, const System<double>& system);

/// "implicit" of explicit_implicit with steps `step` [s]: a list of particles or "courant". Shape (particles).
std::vector<bool> read_implicit_particles(const Value& integrator, const System<double>& system,
                                          const State<double>& start, double step);

/// "integrator", "control" and "schedule" together.
struct Method {
  std::function<std::unique_ptr<Schedule>()> schedule;
  std::optional<SeriesMethod> series;
  std::uint64_t max_steps = 0;
  int threads = 1;
  std::optional<double> fixed_step;
  double mean_orders = 0;
  int largest_degree = 0;
  bool at_least = false;  // mean_orders is a lower bound
};
Method read_method(const Value& scene, std::shared_ptr<const System<double>> system,
                   const State<double>& start, std::uint64_t seed);
/// The types of integrators and of schedules that exist; each but `lockstep` has a record.
std::vector<std::string> integrator_types();
std::vector<std::string> schedule_types();

/// Runs f; a std::invalid_argument becomes a SceneError about `value`.
template <class F>
auto checked(const Value& value, F f) {
  try {
    return f();
  } catch (const std::invalid_argument& error) {
    value.refuse(std::string("such that it works: ") + error.what());
  }
}

/// The member of a register of this name.
template <class Records>
const auto& named(const Records& records, const std::string& name) {
  return *std::ranges::find(records, name, [](const auto& record) { return record.name; });
}

/// The names of a register.
template <class Records>
std::vector<std::string> names_of(const Records& records) {
  std::vector<std::string> names;
  for (const auto& record : records) names.push_back(record.name);
  return names;
}

}  // namespace jetlag
