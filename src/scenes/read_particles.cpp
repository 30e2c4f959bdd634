// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <cmath>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/truncation/draws.hpp"
#include "scenes/choices.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

constexpr std::int64_t max_particles = 5'000'000;

/// A vector for each particle: an array of vectors.
Coordinates<double> read_rows(const Value& rows, int dimension) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count > max_particles) rows.refuse("at most " + std::to_string(max_particles) + " particles");
  Coordinates<double> all(count, dimension);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = rows.at(static_cast<std::size_t>(i)).vector(dimension);
    all.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), dimension);
  }
  return all;
}

/// "velocity": a vector for each particle, one vector for all, or {"normal": deviation}. Fixed particles are at rest.
void read_velocity(const Value& value, std::uint64_t seed, Particles& particles) {
  Coordinates<double>& velocity = particles.state.velocity;
  const auto count = static_cast<std::size_t>(velocity.rows());
  const bool listed = value.is_array() && value.size() > 0 && value.at(0).is_array();
  if (value.is_object()) {
    const double deviation = value.only({"normal"}).at("normal").number(non_negative);
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < particles.dimension; ++c)
        velocity(i, c) = deviation * standard_normal(seed, static_cast<std::uint32_t>(i), c);
  } else if (listed) {
    if (value.size() != count) value.refuse("as many velocities as particles, " + std::to_string(count));
    velocity = read_rows(value, particles.dimension);
  } else {
    const auto all = value.vector(particles.dimension);
    velocity.rowwise() = Eigen::Map<const Eigen::RowVectorXd>(all.data(), particles.dimension);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!particles.fixed[i]) continue;
    if (listed && !velocity.row(i).isZero(0.0)) value.at(i).refuse("zero, because the particle is fixed");
    velocity.row(i).setZero();
  }
}

std::array<double, 3> three(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

void require_dimension(const Value& value, int dimension, int needed) {
  if (dimension != needed)
    throw SceneError("dimension: got " + std::to_string(dimension) + "; must be " + std::to_string(needed) +
                     " for " + value.path());
}

Mesh read_ellipsoid(const Value& value) {
  value.only({"radii", "cells", "cut"});
  const auto radii = three(value.at("radii").vector(3, positive));
  const Value cells = value.at("cells", JsonText{"[8, 8]"}), cut = value.at("cut", JsonText{"[0.9, 0.9]"});
  if (cells.size() != 2) cells.refuse("two numbers: cells across (even), cells along");
  const Range inside{0, 1, false, false, "a number between 0 and 1"};
  const auto cuts = cut.vector(2, inside);
  const auto across = static_cast<int>(cells.at(0).integer(2, 200)),
             along = static_cast<int>(cells.at(1).integer(1, 200));
  return checked(cells, [&] { return truncated_ellipsoid(radii, {across, along}, cuts[0], cuts[1]); });
}

Mesh read_ellipse(const Value& value) {
  value.only({"radii", "cells", "cut"});
  const auto radii = value.at("radii").vector(2, positive);
  const Value cells = value.at("cells", JsonText{"[12, 12]"}), cut = value.at("cut", JsonText{"[0.9, 0.9]"});
  if (cells.size() != 2) cells.refuse("two numbers: cells across, cells along");
  const Range inside{0, 1, false, false, "a number between 0 and 1"};
  const auto cuts = cut.vector(2, inside);
  return truncated_ellipse(
      {radii[0], radii[1]},
      {static_cast<int>(cells.at(0).integer(1, 2000)), static_cast<int>(cells.at(1).integer(1, 2000))},
      cuts[0], cuts[1]);
}

Mesh read_grid(const Value& particles, int dimension) {
  const Value grid = particles.at("grid");
  if (grid.size() < 1 || grid.size() > static_cast<std::size_t>(dimension))
    grid.refuse("1 to " + std::to_string(dimension) + " counts, one for each axis");
  std::vector<int> counts;
  std::int64_t total = 1;
  for (std::size_t a = 0; a < grid.size(); ++a) {
    counts.push_back(static_cast<int>(grid.at(a).integer(1, max_particles)));
    total *= counts.back();
    if (total > max_particles) grid.refuse("at most " + std::to_string(max_particles) + " particles in all");
  }
  const bool cloth = particles.at("springs", "edges").one_of({"edges", "cloth"}) == "cloth";
  return regular_grid(counts, particles.at("spacing").number(positive), dimension, cloth);
}

Mesh read_mesh(const Value& value, const std::filesystem::path& folder) {
  const std::filesystem::path file = std::filesystem::absolute(folder / value.text());
  std::error_code why;
  const bool is_file =
      std::filesystem::is_regular_file(file, why) && file.string().find('\0') == std::string::npos;
  if (!is_file)
    value.refuse("a mesh file that exists; looked for " + shown_name(file.string()) +
                 (why && why != std::errc::no_such_file_or_directory ? ": " + why.message() : ""));
  value.replace(file.string());  // so that the scene can be run from anywhere
  try {
    Mesh mesh = read_medit(file);
    for (std::string& warning : mesh.warnings) warning = value.path() + ": " + warning;
    return mesh;
  } catch (const SceneError& error) {
    throw SceneError(value.path() + ": " + error.what());
  }
}

/// "fix_below", "fix_above": holds what lies within a distance of the lowest or highest vertex, along y.
void fix_ends(const Value& value, Particles& particles) {
  const auto height = particles.state.position.col(std::min(1, particles.dimension - 1));
  if (const auto below = value.find("fix_below")) {
    const double limit = height.minCoeff() + below->number(non_negative);
    for (Eigen::Index i = 0; i < height.size(); ++i)
      if (height[i] <= limit) particles.fixed[i] = true;
  }
  if (const auto above = value.find("fix_above")) {
    const double limit = height.maxCoeff() - above->number(non_negative);
    for (Eigen::Index i = 0; i < height.size(); ++i)
      if (height[i] >= limit) particles.fixed[i] = true;
  }
}

/// Numbers within the range of double may be made into others that are not.
void require_finite(const Value& particles, const char* key, const Coordinates<double>& rows) {
  if (rows.allFinite() && rows.cwiseAbs().maxCoeff() < 1e150) return;
  for (const char* maker : {key, "mesh", "ellipsoid", "ellipse"})
    if (particles.has(maker))
      throw SceneError(particles.path() + "." + maker +
                       ": makes numbers beyond 1e150, whose squares overflow; must be " + "smaller");
}

/// The key that says where particles come from: of the first generator that is there, or "position".
std::string origin_of(const Value& particles) {
  for (const Choice& choice : particle_choices())
    if (choice.name != "position" && particles.has(choice.name)) return choice.name;
  return "position";
}

}  // namespace

const std::vector<Choice>& particle_choices() {
  static const SceneKey mass{"mass", "[kg], 1e-300 to 1e300: one for all or a list", "1"},
      velocity{"velocity",
               "[m/s], one vector for all or a list; a generator takes `{\"normal\": deviation}` too", "0"},
      fixed{"fixed", "a list of particles that do not move", "none"};
  static const auto generator = [](const SceneKeys& own, const SceneKey& springs) {
    return joined({own,
                   {mass,
                    velocity,
                    fixed,
                    {"fix_below",
                     "fixes what is within this distance of the lowest [m], along the second axis", "none"},
                    {"fix_above", "the same of the highest", "none"},
                    springs}});
  };
  static const SceneKey edges{"springs", "which edges there are for springs: `edges`", "edges"};
  static const std::string radii =
      "an object: `radii` [m] along the axes, `cells` (how many across and along), "
      "`cut` (two fractions of the second radius, 0 to 1, where it is cut off)";
  static const std::vector<Choice> choices = {
      {"position", {{"position", "[m], a vector for each particle", "required"}, velocity, mass, fixed}},
      {"mesh", generator({{"mesh",
                           "a Medit file (.mesh) of tetrahedra, beside the scene or with its path; sections "
                           "of other things are passed over, tetrahedra of negative volume turned round",
                           "required"}},
                         edges)},
      {"ellipsoid", generator({{"ellipsoid", radii, "required"}}, edges)},
      {"ellipse", generator({{"ellipse", radii, "required"}}, edges)},
      {"grid",
       generator({{"grid", "counts along one, two or three axes", "required"},
                  {"spacing", "between neighbours [m], > 0", "required"}},
                 {"springs", "`edges`: of neighbours; `cloth`: also diagonals and over two", "edges"})}};
  return choices;
}

Particles read_particles(const Value& value, int dimension, std::uint64_t seed,
                         const std::filesystem::path& folder) {
  if (!value.is_object())
    value.refuse("an object: positions, or a generator such as mesh, grid, ellipse, ellipsoid");
  Particles particles;
  particles.dimension = dimension;
  const std::string origin = origin_of(value);
  std::vector<std::string_view> keys;
  for (const SceneKey& key : named(particle_choices(), origin).keys) keys.push_back(key.key);
  value.only(keys);
  if (origin == "mesh") {
    require_dimension(value.at("mesh"), dimension, 3);
    particles.mesh = read_mesh(value.at("mesh"), folder);
  } else if (origin == "ellipsoid") {
    require_dimension(value.at("ellipsoid"), dimension, 3);
    particles.mesh = read_ellipsoid(value.at("ellipsoid"));
  } else if (origin == "ellipse") {
    require_dimension(value.at("ellipse"), dimension, 2);
    particles.mesh = read_ellipse(value.at("ellipse"));
  } else if (origin == "grid") {
    particles.mesh = read_grid(value, dimension);
  } else {
    particles.state.position = read_rows(value.at("position"), dimension);
  }
  if (!value.has("position")) {
    particles.state.position = particles.mesh.position;
    if (!value.has("grid")) value.at("springs", "edges").one_of({"edges"});
  }
  const auto count = static_cast<std::size_t>(particles.state.position.rows());
  if (count == 0) value.at("position").refuse("at least one particle");

  particles.mass =
      value.at("mass", 1.0)
          .numbers(count, {1e-300, 1e300, true, true, "a number > 0, from 1e-300 to 1e300"}, "particle");
  particles.fixed.assign(count, false);
  const Value fixed = value.at("fixed", JsonText{"[]"});
  for (std::size_t i = 0; i < fixed.size(); ++i)
    particles.fixed[fixed.at(i).integer(0, static_cast<std::int64_t>(count) - 1)] = true;
  fix_ends(value, particles);
  particles.state.velocity = Coordinates<double>::Zero(particles.state.position.rows(), dimension);
  read_velocity(value.at("velocity", std::vector<double>(dimension, 0.0)), seed, particles);
  require_finite(value, value.has("position") ? "position" : "grid", particles.state.position);
  require_finite(value, "velocity", particles.state.velocity);
  return particles;
}

}  // namespace jetlag
