// SPDX-License-Identifier: MIT
// Forces of surfaces that touch.
#include <algorithm>
#include <map>
#include <set>

#include "jetlag/base/text.hpp"
#include "jetlag/contact/clearance.hpp"
#include "jetlag/output/shape.hpp"
#include "scenes/choices.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

struct Features {
  Cells<3> triangles{};
  Cells<2> edges{};
  std::vector<int> points{};
};

std::vector<int> all_own(const Particles& particles) {
  std::vector<int> all(particles.own);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return all;
}

/// The edges of one triangle only.
Cells<2> border_of(const Cells<3>& triangles) {
  std::map<std::array<int, 2>, int> owners;
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {std::array{a, b}, {b, c}, {c, a}})
      ++owners[{std::min(from, to), std::max(from, to)}];
  Cells<2> border;
  for (const auto& [edge, count] : owners)
    if (count == 1) border.push_back(edge);
  return border;
}

/// The outside of a grid: faces of a block or of a net in space, the border of a net in the plane, the edges of a row.
Features outside_of_grid(const std::vector<int>& counts, int dimension) {
  struct Axis {
    int count, stride;
  };
  std::vector<Axis> axes;
  int stride = 1;
  for (auto count = counts.rbegin(); count != counts.rend(); stride *= *count++)
    if (*count > 1) axes.insert(axes.begin(), {*count, stride});
  Features outside;
  const auto net = [&](const Axis& across, const Axis& along, int first, bool is_turned) {
    for (int i = 0; i + 1 < across.count; ++i)
      for (int j = 0; j + 1 < along.count; ++j) {
        const int a = first + i * across.stride + j * along.stride, d = a + along.stride;
        int b = a + across.stride, c = b + along.stride;
        outside.triangles.push_back(is_turned ? std::array{a, c, b} : std::array{a, b, c});
        outside.triangles.push_back(is_turned ? std::array{a, d, c} : std::array{a, c, d});
      }
  };
  if (axes.empty()) outside.points = {0};
  if (axes.size() == 1)
    for (int i = 0; i + 1 < axes[0].count; ++i)
      outside.edges.push_back({i * axes[0].stride, (i + 1) * axes[0].stride});
  if (axes.size() == 2) net(axes[0], axes[1], 0, false);
  if (axes.size() == 3)
    for (int normal = 0; normal < 3; ++normal) {
      const Axis &across = axes[(normal + 1) % 3], &along = axes[(normal + 2) % 3];
      net(across, along, 0, true);
      net(across, along, (axes[normal].count - 1) * axes[normal].stride, false);
    }
  if (dimension == 2) outside.edges = axes.size() == 2 ? border_of(outside.triangles) : outside.edges;
  if (dimension == 2) outside.triangles.clear();
  return outside;
}

Features boundary_of(const Value& surface, const Particles& particles) {
  if (particles.dimension == 1) return {.points = all_own(particles)};
  if (!particles.grid.empty()) return outside_of_grid(particles.grid, particles.dimension);
  const Mesh& mesh = particles.mesh;
  if (mesh.triangles.empty() && mesh.tetrahedra.empty())
    surface.refuse("\"points\", or triangles, edges or points must be listed: these particles have no mesh");
  if (particles.dimension == 2) return {.edges = border_of(mesh.triangles)};
  Features features{.triangles = boundary(mesh.tetrahedra, particles.rest)};
  std::set<std::array<int, 3>> known;
  const auto is_new = [&](std::array<int, 3> members) {
    std::ranges::sort(members);
    return known.insert(members).second;
  };
  for (const auto& triangle : features.triangles) is_new(triangle);
  for (const auto& triangle : mesh.triangles)
    if (is_new(triangle)) features.triangles.push_back(triangle);
  return features;
}

template <std::size_t P>
Cells<P> read_listed_features(const Value& list, const Particles& particles) {
  Cells<P> cells;
  if (!list.is_array()) list.refuse("a list");
  for (std::size_t e = 0; e < list.size(); ++e)
    cells.push_back(read_members<P>(list.at(e), particles.rest.rows()));
  require_no_repeats<P>(list, cells);
  require_extent<P>(list, cells, particles.rest);
  return cells;
}

std::vector<int> read_points(const Value& list, const Particles& particles) {
  std::vector<int> points;
  if (list.size() == 0) list.refuse("such that there are points");
  for (std::size_t i = 0; i < list.size(); ++i) {
    points.push_back(static_cast<int>(list.at(i).integer(0, particles.rest.rows() - 1)));
    if (std::ranges::count(points, points.back()) > 1) list.at(i).refuse("a particle that is not listed yet");
  }
  return points;
}

/// "triangles", "edges", "points", or what "surface" stands for; obstacles come with it.
Features read_features(const Value& force, const Particles& particles) {
  const auto triangles = force.find("triangles"), edges = force.find("edges"), points = force.find("points");
  if (!triangles && !edges && !points) {
    const Value surface = force.at("surface", "boundary");
    if (surface.one_of({"boundary", "points"}) == "points") return {.points = all_own(particles)};
    return boundary_of(surface, particles);
  }
  if (const auto surface = force.find("surface"))
    surface->refuse("left out beside triangles, edges or points");
  Features listed;
  if (triangles) {
    require_dimension(*triangles, particles.dimension, 3, 3,
                      particles.dimension == 2 ? ": in the plane take edges" : "");
    listed.triangles = read_listed_features<3>(*triangles, particles);
  }
  if (edges) {
    require_dimension(*edges, particles.dimension, 2, 3, ": on a line take points");
    listed.edges = read_listed_features<2>(*edges, particles);
  }
  if (points) listed.points = read_points(*points, particles);
  return listed;
}

/// What pictures show of it that they would not show otherwise.
void draw_triangles(const Cells<3>& triangles, Drawn& drawn) {
  std::set<std::array<int, 3>> known;
  const auto is_new = [&](std::array<int, 3> members) {
    std::ranges::sort(members);
    return known.insert(members).second;
  };
  for (const auto& triangle : drawn.triangles) is_new(triangle);
  for (const auto& triangle : triangles)
    if (is_new(triangle)) drawn.triangles.push_back(triangle);
}

void warn_of_neighbours(const Value& force, const ContactBarrier& contact, ForcesRead& into) {
  const auto nearest = nearest_of_one_body(into.system, contact);
  if (!nearest) return;
  const double most = nearest->distance - contact.gap;
  into.warnings.push_back(force.path() + ".thickness: " + names_of(nearest->stencil) + " of one body are " +
                          shown(nearest->distance) + " m apart at rest, and push each other from " +
                          shown(contact.gap + contact.thickness) + " m on; " +
                          (most > 0 ? "a thickness up to " + shown(most) + " m leaves them alone"
                                    : "no thickness leaves them alone"));
}

void read_contact_barrier(const Value& force, ForcesRead& into) {
  const Particles& particles = into.particles;
  Features features = read_features(force, particles);
  ContactBarrier contact;
  constexpr double most = 1e150;  // whose square is a number
  contact.thickness = force.at("thickness").number({0, most, false, true, "a number > 0, up to 1e150"});
  contact.stiffness = force.at("stiffness").number(positive);
  contact.gap = force.at("gap", 0.0).number({0, most, true, true, "a number >= 0, up to 1e150"});
  contact.power = force.at("power", 7).number({1, 7, true, true, "a number from 1 to 7"});
  contact.with_itself = force.at("self", true).boolean();
  contact.rest = particles.rest;
  contact.record = std::make_shared<ContactRecord>();
  checked(force, [&] {
    contact.surface = Surface(features.triangles, features.edges, features.points);
    contact.surface += particles.obstacles;
    add(into.system, contact);
    return true;
  });
  try {
    require_apart(into.system, contact, particles.state.position);
  } catch (const std::invalid_argument& why) {
    throw SceneError(force.path() + ": " + why.what());
  }
  warn_of_neighbours(force, contact, into);
  draw_triangles(features.triangles, into.drawn);
  into.contacts.push_back(contact.record);
}

}  // namespace

std::vector<ForceRecord> contact_records() {
  return {
      {"contact_barrier",
       "Surfaces that touch: features of them that are nearer to each other than `thickness` (vertices, "
       "edges, "
       "triangles; those of `obstacles` too) are pushed apart by a force that grows without bound as their "
       "gap "
       "closes. With `taylor` and `random_taylor` in `lockstep`; steps that a control chooses end where "
       "contacts "
       "begin and end, and pass through nothing. Energy, momentum and angular momentum are kept. It does not "
       "count for "
       "`courant`",
       {{"surface",
         "what may touch: `boundary`, the faces of a mesh or of a grid in space, edges in the plane, points "
         "on a line; "
         "`points`, all particles",
         "boundary"},
        {"triangles", "in place of surface: lists of three particles, with their edges and vertices", "none"},
        {"edges", "lists of two, with their vertices", "none"},
        {"points", "a list of particles", "none"},
        {"thickness", "of the layer in which the barrier acts [m], > 0", "required"},
        {"stiffness", "[N/m], > 0", "required"},
        {"gap", "what is kept in any case [m], >= 0: the layer lies beyond it", "0"},
        {"power", "how fast the barrier grows, 1 to 7: gap^(-2 power)", "7"},
        {"self", "true, false: whether a body, held together by edges of the surface, touches itself",
         "true"}},
       read_contact_barrier}};
}

}  // namespace jetlag
