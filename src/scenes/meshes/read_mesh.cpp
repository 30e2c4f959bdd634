// SPDX-License-Identifier: MIT
// Where the meshes of a scene come from: generators, files, lists.
#include <Eigen/Core>
#include <cctype>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

std::array<double, 3> three(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

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

Mesh read_box(const Value& value, int dimension) {
  value.only({"lengths", "cells", "corner"});
  require_dimension(value, dimension, 2, 3);
  const auto lengths = value.at("lengths").vector(dimension, positive);
  const Value listed = value.at("cells");
  if (listed.size() != static_cast<std::size_t>(dimension))
    listed.refuse("an array of " + std::to_string(dimension) + " numbers");
  std::array<int, 3> cells{};
  std::int64_t vertices = 1;
  for (int axis = 0; axis < dimension; ++axis) {
    cells[axis] = static_cast<int>(listed.at(axis).integer(1, max_particles));
    vertices *= cells[axis] + 1;
    if (vertices > max_particles)
      listed.refuse("at most " + std::to_string(max_particles) + " vertices in all");
  }
  const auto corner = value.at("corner", std::vector<double>(dimension, 0.0)).vector(dimension);
  Mesh mesh =
      dimension == 3 ? box(three(lengths), cells) : rectangle({lengths[0], lengths[1]}, {cells[0], cells[1]});
  for (int axis = 0; axis < dimension; ++axis) mesh.position.col(axis).array() += corner[axis];
  return mesh;
}

/// "tetrahedra" in space or "triangles" in the plane of listed positions, each of different particles.
template <std::size_t P>
std::vector<std::array<int, P>> read_listed_cells(const Value& list, Eigen::Index count) {
  std::vector<std::array<int, P>> cells;
  for (std::size_t e = 0; e < list.size(); ++e) cells.push_back(read_members<P>(list.at(e), count));
  require_no_repeats<P>(list, cells);
  return cells;
}

/// Of listed positions.
Mesh read_cells(const Value& particles, int dimension, Eigen::Index count) {
  Mesh mesh;
  if (const auto list = particles.find("tetrahedra")) {
    require_dimension(*list, dimension, 3, 3);
    mesh.tetrahedra = read_listed_cells<4>(*list, count);
  }
  if (const auto list = particles.find("triangles")) {
    require_dimension(*list, dimension, 2, 3);
    mesh.triangles = read_listed_cells<3>(*list, count);
  }
  mesh.edges = edges_of(mesh.tetrahedra, mesh.triangles);
  return mesh;
}

Mesh read_sheet(const Value& value) {
  value.only({"lengths", "cells", "pattern", "corner"});
  const auto lengths = value.at("lengths").vector(2, positive);
  const Value cells = value.at("cells");
  if (cells.size() != 2) cells.refuse("two numbers: cells along x, cells along y");
  const std::array<int, 2> counts{static_cast<int>(cells.at(0).integer(1, 2000)),
                                  static_cast<int>(cells.at(1).integer(1, 2000))};
  const auto corner = value.at("corner", std::vector<double>(3, 0.0)).vector(3);
  const std::string pattern =
      value.at("pattern", "equilateral").one_of({"equilateral", "crisscross", "uniform"});
  Mesh mesh = sheet({lengths[0], lengths[1]}, counts,
                    pattern == "equilateral"  ? SheetPattern::equilateral
                    : pattern == "crisscross" ? SheetPattern::crisscross
                                              : SheetPattern::uniform);
  for (int axis = 0; axis < 3; ++axis) mesh.position.col(axis).array() += corner[axis];
  return mesh;
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

}  // namespace

Mesh read_mesh_file(const Value& value, const std::filesystem::path& folder) {
  const std::filesystem::path file = std::filesystem::absolute(folder / value.text());
  std::error_code why;
  const bool is_file =
      std::filesystem::is_regular_file(file, why) && file.string().find('\0') == std::string::npos;
  if (!is_file)
    value.refuse("a mesh file that exists; looked for " + shown_name(file.string()) +
                 (why && why != std::errc::no_such_file_or_directory ? ": " + why.message() : ""));
  value.replace(file.string());  // so that the scene can be run from anywhere
  try {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    Mesh mesh = ending == ".obj" ? read_wavefront(file) : read_medit(file);
    for (std::string& warning : mesh.warnings) warning = value.path() + ": " + warning;
    return mesh;
  } catch (const SceneError& error) {
    throw SceneError(value.path() + ": " + error.what());
  }
}

Mesh read_mesh(const std::string& origin, const Value& particles, Eigen::Index listed, int dimension,
               const std::filesystem::path& folder) {
  if (origin == "position") return read_cells(particles, dimension, listed);
  const Value value = particles.at(origin);
  if (origin == "box") return read_box(value, dimension);
  if (origin == "grid") return read_grid(particles, dimension);
  const int needed = origin == "ellipse" ? 2 : 3;
  require_dimension(value, dimension, needed, needed);
  if (origin == "ellipsoid") return read_ellipsoid(value);
  if (origin == "ellipse") return read_ellipse(value);
  if (origin == "sheet") return read_sheet(value);
  return read_mesh_file(value, folder);
}

}  // namespace jetlag
