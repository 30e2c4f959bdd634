// SPDX-License-Identifier: MIT
#pragma once
// Elements of solids and of cloth in a scene: which ones there are.

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "jetlag/forces/solids/simplex.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

template <std::size_t P>
using Cells = std::vector<std::array<int, P>>;

/// Where it stands in a list; all of what a word stands for have the path of the word.
inline std::string path_of(const Value& list, std::size_t e) {
  return list.is_array() ? list.path() + "[" + std::to_string(e) + "]"
                         : list.path() + ", number " + std::to_string(e);
}

/// Refuses a list that is empty, and one that names the same particles twice.
template <std::size_t P>
void require_no_repeats(const Value& list, const Cells<P>& cells) {
  if (cells.empty()) list.refuse("such that there are elements");
  std::map<std::array<int, P>, std::size_t> first;
  for (std::size_t e = 0; e < cells.size(); ++e) {
    std::array<int, P> members = cells[e];
    std::ranges::sort(members);
    if (const auto [known, is_new] = first.emplace(members, e); !is_new)
      throw SceneError(path_of(list, e) + ": the same particles as of number " +
                       std::to_string(known->second) + "; must be listed once");
  }
}

/// {"inside": [low, high]}, {"outside": [low, high]}: cells whose middle at rest is within the box of two corners, or not.
template <std::size_t P>
Cells<P> selected(const Value& value, const Cells<P>& from, const Particles& particles) {
  value.only({"inside", "outside"});
  const bool inside = value.has("inside");
  if (inside == value.has("outside")) value.refuse("an object with inside or outside");
  const Value corners = value.at(inside ? "inside" : "outside");
  const int dimension = particles.dimension;
  if (!corners.is_array() || corners.size() != 2) corners.refuse("two corners of a box, the lowest first");
  const auto low = corners.at(0).vector(dimension), high = corners.at(1).vector(dimension);
  for (int c = 0; c < dimension; ++c)
    if (!(low[c] <= high[c])) corners.refuse("two corners of a box, the lowest first");
  Cells<P> kept;
  for (const auto& cell : from) {
    bool within = true;
    for (int c = 0; c < dimension; ++c) {
      double middle = 0;
      for (const int i : cell) middle += particles.rest(i, c) / P;
      within = within && low[c] <= middle && middle <= high[c];
    }
    if (within == inside) kept.push_back(cell);
  }
  if (kept.empty()) value.refuse("such that there are elements");
  return kept;
}

template <std::size_t P>
const Cells<P>& cells_of(const Mesh& mesh) {
  if constexpr (P == 4)
    return mesh.tetrahedra;
  else
    return mesh.triangles;
}

/// "elements": "mesh", a part of it, or a list.
template <std::size_t P>
Cells<P> read_elements(const Value& value, const Particles& particles, Drawn& drawn) {
  const Cells<P>& mesh = cells_of<P>(particles.mesh);
  if (!value.is_array()) {
    if (!value.is_object() && !value.is_string())
      value.refuse("\"mesh\", an object with inside or outside, or a list of elements");
    if (value.is_string()) value.one_of({"mesh"});
    if (mesh.empty())
      value.refuse(std::string("a list of ") + (P == 4 ? "tetrahedra" : "triangles") +
                   ": these particles have none");
    return value.is_object() ? selected<P>(value, mesh, particles) : mesh;
  }
  Cells<P> cells;
  for (std::size_t e = 0; e < value.size(); ++e)
    cells.push_back(read_members<P>(value.at(e), particles.rest.rows()));
  require_no_repeats<P>(value, cells);
  if constexpr (P == 4)
    drawn.tetrahedra.insert(drawn.tetrahedra.end(), cells.begin(), cells.end());
  else
    drawn.triangles.insert(drawn.triangles.end(), cells.begin(), cells.end());
  return cells;
}

/// In D dimensions.
template <int D, std::size_t P>
std::array<Vector<double, D>, P> corners_of(const std::array<int, P>& cell,
                                            const Coordinates<double>& position) {
  std::array<Vector<double, D>, P> x;
  for (std::size_t i = 0; i < P; ++i) x[i] = position.row(cell[i]);
  return x;
}

/// Refuses edges without length and triangles without area.
template <std::size_t P>
void require_extent(const Value& value, const Cells<P>& cells, const Coordinates<double>& position) {
  for (std::size_t e = 0; e < cells.size(); ++e) {
    std::array<Eigen::Vector3d, P> x;
    for (std::size_t i = 0; i < P; ++i) {
      x[i].setZero();
      x[i].head(position.cols()) = position.row(cells[e][i]);
    }
    const Eigen::Vector3d a = x[1] - x[0], b = x[P - 1] - x[0];
    const bool has = P == 2 ? a.norm() > 0 : a.cross(b).norm() > 1e-12 * a.norm() * b.norm();
    if (!has)
      throw SceneError(path_of(value, e) + ": has no " + (P == 2 ? "length" : "area") +
                       "; its particles must not be " + (P == 2 ? "in one place" : "in one line"));
  }
}

/// Refuses elements that are flat or inside out at rest.
template <int D, std::size_t P>
void require_rest_shapes(const Value& value, const Cells<P>& cells, const Coordinates<double>& rest) {
  for (std::size_t e = 0; e < cells.size(); ++e) try {
      detail::rest_shape<double, D, P - 1>(corners_of<D>(cells[e], rest));
    } catch (const std::invalid_argument& why) {
      throw SceneError(path_of(value, e) + ": " + why.what());
    }
}

}  // namespace jetlag
