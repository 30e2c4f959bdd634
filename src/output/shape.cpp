// SPDX-License-Identifier: MIT
// The boundary of a tetrahedral mesh; frames that fit their shape.
#include "jetlag/output/shape.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace jetlag {

namespace {

using Triangle = std::array<int, 3>;

Triangle sorted(Triangle triangle) {
  std::ranges::sort(triangle);
  return triangle;
}

void check(const std::array<int, 4>& tetrahedron, Eigen::Index particles) {
  for (const int corner : tetrahedron)
    if (corner < 0 || corner >= particles)
      throw std::invalid_argument(
          fmt::format("boundary: particle {} does not exist, there are {}", corner, particles));
}

/// The four faces of a tetrahedron, turning left when seen from outside.
std::array<Triangle, 4> faces(const std::array<int, 4>& tetrahedron, const Coordinates<double>& position) {
  auto [a, b, c, d] = tetrahedron;
  const auto edge = [&](int corner) -> Eigen::Vector3d { return position.row(corner) - position.row(a); };
  if (edge(b).cross(edge(c)).dot(edge(d)) < 0.0) std::swap(c, d);
  return {{{a, c, b}, {a, b, d}, {b, c, d}, {a, d, c}}};
}

void check(const Coordinates<double>& values, const Shape& shape, const char* name) {
  if (values.rows() != shape.particles || values.cols() != shape.dimension)
    throw std::invalid_argument(fmt::format("frame: {} must have shape ({}, {}), got ({}, {})", name,
                                            shape.particles, shape.dimension, values.rows(), values.cols()));
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (!values.row(i).allFinite())
      throw std::invalid_argument(fmt::format("frame: the {} of particle {} is not finite", name, i));
}

}  // namespace

std::vector<Triangle> boundary(const std::vector<std::array<int, 4>>& tetrahedra,
                               const Coordinates<double>& position) {
  if (position.cols() != 3) throw std::invalid_argument("boundary: tetrahedra need three dimensions");
  std::map<Triangle, int> owners;
  for (const auto& tetrahedron : tetrahedra) {
    check(tetrahedron, position.rows());
    for (const Triangle& face : faces(tetrahedron, position)) ++owners[sorted(face)];
  }
  std::vector<Triangle> found;
  for (const auto& tetrahedron : tetrahedra)
    for (const Triangle& face : faces(tetrahedron, position))
      if (owners.at(sorted(face)) == 1) found.push_back(face);
  return found;
}

void check_frame(const Shape& shape, const Frame& frame) {
  if (shape.dimension < 1 || shape.dimension > 3)
    throw std::invalid_argument(fmt::format("shape: dimension must be 1, 2 or 3, got {}", shape.dimension));
  if (!std::isfinite(frame.time)) throw std::invalid_argument("frame: the time is not finite");
  check(frame.position, shape, "position");
  check(frame.velocity, shape, "velocity");
  const auto check_members = [&](const auto& cells) {
    for (const auto& cell : cells)
      for (const int particle : cell)
        if (particle < 0 || particle >= shape.particles)
          throw std::invalid_argument(
              fmt::format("shape: particle {} does not exist, there are {}", particle, shape.particles));
  };
  check_members(shape.lines);
  check_members(shape.walls);
  check_members(shape.surface);
  check_members(shape.tetrahedra);
  check_members(std::array{shape.fixed});
}

}  // namespace jetlag
