// SPDX-License-Identifier: MIT
// Meshes made from a regular grid of cells, bent into shape.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/triangle_grid.hpp"

namespace jetlag {

namespace {

/// The vertices of a grid, numbered along z, then y, then x.
struct Grid {
  int nx, ny, nz;
  int operator()(int i, int j, int k) const { return (i * ny + j) * nz + k; }
};

/// Half-width of the ellipse or ellipsoid at height fraction f, as a fraction of its radius.
double half_width(double f) { return std::sqrt(1.0 - f * f); }

void require_cuts(double lower, double upper) {
  if (!(lower > 0 && lower < 1 && upper > 0 && upper < 1))
    throw std::invalid_argument("the cuts must lie in (0, 1)");
}

}  // namespace

Mesh truncated_ellipsoid(std::array<double, 3> radii, std::array<int, 2> cells, double lower, double upper) {
  require_cuts(lower, upper);
  const auto [across, along] = cells;
  if (across < 2 || across % 2 != 0 || along < 1)
    throw std::invalid_argument("cells: an even number >= 2 across and a number >= 1 along are needed");
  const Grid grid{across + 1, along + 1, across + 1};
  Mesh mesh;
  mesh.position.resize(grid.nx * grid.ny * grid.nz, 3);
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j)
      for (int k = 0; k < grid.nz; ++k) {
        const double u = 2.0 * i / across - 1, w = 2.0 * k / across - 1;  // a square, mapped to a disc:
        const double x = u * std::sqrt(1 - w * w / 2), z = w * std::sqrt(1 - u * u / 2);
        const double f = -lower + (lower + upper) * j / along, wide = half_width(f);
        mesh.position.row(grid(i, j, k)) << radii[0] * wide * x, radii[1] * f, radii[2] * wide * z;
      }
  // Kuhn's six tetrahedra in each cube, along its diagonal; mirrored in x and z so that the diagonals run outwards and
  // the corners of the square, which become flat on the circle, are never cut off as slivers.
  static constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j)
      for (int k = 0; k < across; ++k)
        for (const auto& order : orders) {
          const std::array<int, 3> inner{i < across / 2 ? i + 1 : i, j, k < across / 2 ? k + 1 : k};
          const std::array<int, 3> outer{i < across / 2 ? i : i + 1, j + 1, k < across / 2 ? k : k + 1};
          std::array<int, 3> corner = inner;
          std::array<int, 4> t{grid(corner[0], corner[1], corner[2])};
          for (int s = 0; s < 3; ++s) {
            corner[order[s]] = outer[order[s]];
            t[s + 1] = grid(corner[0], corner[1], corner[2]);
          }
          if (six_volumes(mesh.position, t) < 0) std::swap(t[2], t[3]);
          mesh.tetrahedra.push_back(t);
        }
  mesh.edges = edges_of(mesh.tetrahedra, {});
  return mesh;
}

Mesh truncated_ellipse(std::array<double, 2> radii, std::array<int, 2> cells, double lower, double upper) {
  require_cuts(lower, upper);
  const auto [across, along] = cells;
  if (across < 1 || along < 1) throw std::invalid_argument("cells: two numbers >= 1 are needed");
  const Grid grid{across + 1, along + 1, 1};
  Mesh mesh;
  mesh.position.resize(grid.nx * grid.ny, 2);
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      const double f = -lower + (lower + upper) * j / along;
      mesh.position.row(grid(i, j, 0)) << radii[0] * half_width(f) * (2.0 * i / across - 1), radii[1] * f;
    }
  add_triangles(
      across, along, [&](int i, int j) { return grid(i, j, 0); },
      [](int i, int j) { return (i + j) % 2 == 0; }, mesh);
  mesh.edges = edges_of({}, mesh.triangles);
  return mesh;
}

Mesh regular_grid(const std::vector<int>& counts, double spacing, int dimension, bool cloth) {
  const int axes = static_cast<int>(counts.size());
  if (axes < 1 || axes > dimension) throw std::invalid_argument("a grid has 1 to `dimension` axes");
  const Grid grid{counts[0], axes > 1 ? counts[1] : 1, axes > 2 ? counts[2] : 1};
  Mesh mesh;
  mesh.position = Coordinates<double>::Zero(grid.nx * grid.ny * grid.nz, dimension);
  // Steps to neighbours: along the axes; for a cloth, all diagonals of the cells and two along an axis.
  std::vector<std::array<int, 3>> steps{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (cloth) {
    for (const int p : {1, -1})
      for (const auto& s : {std::array{1, p, 0}, std::array{1, 0, p}, std::array{0, 1, p}})
        steps.push_back(s);
    for (int a = 0; a < 3; ++a) {
      std::array<int, 3> two{};
      two[a] = 2;
      steps.push_back(two);
    }
  }
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j)
      for (int k = 0; k < grid.nz; ++k) {
        const std::array<int, 3> at{i, j, k};
        for (int c = 0; c < axes; ++c) mesh.position(grid(i, j, k), c) = spacing * at[c];
        for (const auto& s : steps) {
          const int x = i + s[0], y = j + s[1], z = k + s[2];
          if (x < grid.nx && y >= 0 && y < grid.ny && z >= 0 && z < grid.nz) {
            const int a = grid(i, j, k), b = grid(x, y, z);
            mesh.edges.push_back({std::min(a, b), std::max(a, b)});
          }
        }
      }
  std::ranges::sort(mesh.edges);
  return mesh;
}

}  // namespace jetlag
