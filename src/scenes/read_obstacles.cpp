// SPDX-License-Identifier: MIT
// Obstacles: what bodies may touch and nothing moves.
#include <algorithm>
#include <numbers>
#include <string>

#include "jetlag/output/shape.hpp"
#include "scenes/choices.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

/// One obstacle; its vertices are counted from 0.
struct Obstacle {
  Coordinates<double> position;
  Cells<3> triangles;
  Cells<2> edges;
  std::vector<std::string> warnings{};
};

Obstacle read_sphere(const Value& value, int dimension) {
  value.only({"center", "radius", "cells"});
  require_dimension(value, dimension, 2, 3);
  const auto center = value.at("center", std::vector<double>(dimension, 0.0)).vector(dimension);
  const double radius = value.at("radius").number(positive);
  const auto cells = static_cast<int>(value.at("cells", 4).integer(1, 200));
  Obstacle sphere;
  if (dimension == 3) {
    Mesh mesh = geodesic_sphere(radius, cells);
    sphere.position = std::move(mesh.position);
    sphere.triangles = std::move(mesh.triangles);
  } else {
    const int corners = 6 * cells;
    sphere.position.resize(corners, 2);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      sphere.position.row(i) << radius * std::cos(angle), radius * std::sin(angle);
      sphere.edges.push_back({std::min(i, (i + 1) % corners), std::max(i, (i + 1) % corners)});
    }
  }
  sphere.position.rowwise() += Eigen::Map<const Eigen::RowVectorXd>(center.data(), dimension);
  return sphere;
}

Obstacle read_mesh_obstacle(const Value& value, int dimension, const std::filesystem::path& folder) {
  require_dimension(value, dimension, 3, 3);
  Mesh mesh = read_mesh_file(value, folder);
  Obstacle obstacle;
  if (!mesh.tetrahedra.empty()) obstacle.triangles = boundary(mesh.tetrahedra, mesh.position);
  obstacle.position = std::move(mesh.position);
  obstacle.triangles.insert(obstacle.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  require_extent<3>(value, obstacle.triangles, obstacle.position);
  obstacle.warnings = std::move(mesh.warnings);
  return obstacle;
}

template <std::size_t P>
Cells<P> read_features(const Value& list, const Coordinates<double>& position) {
  Cells<P> cells;
  for (std::size_t e = 0; e < list.size(); ++e) cells.push_back(read_members<P>(list.at(e), position.rows()));
  if (!cells.empty()) require_no_repeats<P>(list, cells);
  require_extent<P>(list, cells, position);
  return cells;
}

Obstacle read_listed(const Value& value, int dimension) {
  const Value rows = value.at("position");
  if (!rows.is_array() || rows.size() == 0) rows.refuse("at least one vertex");
  Obstacle obstacle;
  obstacle.position.resize(static_cast<Eigen::Index>(rows.size()), dimension);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows.at(i).vector(dimension);
    obstacle.position.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(row.data(), dimension);
  }
  if (const auto triangles = value.find("triangles")) {
    require_dimension(*triangles, dimension, 3, 3, ": in the plane take edges");
    obstacle.triangles = read_features<3>(*triangles, obstacle.position);
  }
  if (const auto edges = value.find("edges")) {
    require_dimension(*edges, dimension, 2, 3, ": on a line take points");
    obstacle.edges = read_features<2>(*edges, obstacle.position);
  }
  return obstacle;
}

Obstacle read_obstacle(const Value& value, const Particles& particles, const std::filesystem::path& folder) {
  const auto& choices = obstacle_choices();
  const auto chosen = std::ranges::find_if(choices, [&](const Choice& one) { return value.has(one.name); });
  if (!value.is_object() || chosen == choices.end())
    value.refuse("an object with mesh, sphere, or position and triangles or edges");
  std::vector<std::string_view> keys;
  for (const SceneKey& key : chosen->keys) keys.push_back(key.key);
  value.only(keys);
  const int dimension = particles.dimension;
  if (chosen->name == "sphere") return read_sphere(value.at("sphere"), dimension);
  if (chosen->name == "mesh") return read_mesh_obstacle(value.at("mesh"), dimension, folder);
  return read_listed(value, dimension);
}

/// Rows below others.
void append_rows(Coordinates<double>& to, const Coordinates<double>& more) {
  const Eigen::Index before = to.rows();
  to.conservativeResize(before + more.rows(), to.cols());
  to.bottomRows(more.rows()) = more;
}

/// The particles that the vertices become.
template <std::size_t P>
Cells<P> shifted_cells(Cells<P> cells, int by) {
  for (auto& members : cells)
    for (int& member : members) member += by;
  return cells;
}

void add_obstacle(Obstacle& obstacle, Particles& particles) {
  const auto first = static_cast<int>(particles.mass.size());
  const auto count = static_cast<std::size_t>(obstacle.position.rows());
  append_rows(particles.state.position, obstacle.position);
  append_rows(particles.rest, obstacle.position);
  append_rows(particles.state.velocity,
              Coordinates<double>::Zero(obstacle.position.rows(), particles.dimension));
  particles.mass.resize(first + count, 1.0);
  particles.fixed.resize(first + count, true);
  std::vector<int> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = first + static_cast<int>(i);
  const Cells<3> triangles = shifted_cells<3>(std::move(obstacle.triangles), first);
  particles.obstacles += Surface(triangles, shifted_cells<2>(std::move(obstacle.edges), first), points);
  particles.walls.insert(particles.walls.end(), triangles.begin(), triangles.end());
}

}  // namespace

const std::vector<Choice>& obstacle_choices() {
  static const std::vector<Choice> choices = {
      {"mesh",
       {{"mesh", "a file as of particles, in space: the boundary of its tetrahedra, its triangles",
         "required"}}},
      {"sphere",
       {{"sphere",
         "an object: `center` [m] (the origin where it is left out), `radius` [m], `cells`, 1 to 200 (4 "
         "where it is "
         "left out): into how many parts each edge of an icosahedron is cut, whose vertices then go to the "
         "sphere; in "
         "the plane a circle of 6 times as many edges",
         "required"}}},
      {"position",
       {{"position", "[m], a vector for each vertex", "required"},
        {"triangles", "lists of three vertices, counted from 0 in this obstacle; in space", "none"},
        {"edges", "lists of two; what is in no triangle and no edge is a point", "none"}}}};
  return choices;
}

void read_obstacles(const Value& obstacles, const std::filesystem::path& folder, Particles& particles) {
  if (!obstacles.is_array()) obstacles.refuse("a list of objects");
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const Value value = obstacles.at(o);
    Obstacle obstacle = read_obstacle(value, particles, folder);
    if (static_cast<std::int64_t>(particles.mass.size()) + obstacle.position.rows() > max_particles)
      value.refuse("fewer vertices: at most " + std::to_string(max_particles) + " with the particles");
    if (!obstacle.position.allFinite() || obstacle.position.cwiseAbs().maxCoeff() > 1e150)
      value.refuse("within 1e150 m, beyond which squares overflow");
    particles.mesh.warnings.insert(particles.mesh.warnings.end(), obstacle.warnings.begin(),
                                   obstacle.warnings.end());
    checked(value, [&] {
      add_obstacle(obstacle, particles);
      return true;
    });
  }
}

}  // namespace jetlag
