// SPDX-License-Identifier: MIT
// Boxes and rectangles cut into simplices.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "jetlag/scenes/mesh.hpp"

namespace jetlag {

namespace {

/// The simplices of the cell at `corner`: from it to the opposite corner along the axes in every order.
/// vertex: the number of the vertex at a place in cells.
template <int D, class F>
void cut(const std::array<int, D>& corner, F vertex, std::vector<std::array<int, D + 1>>& simplices) {
  std::array<int, D> order{};
  for (int axis = 0; axis < D; ++axis) order[axis] = axis;
  do {
    std::array<int, D> at = corner;
    std::array<int, D + 1> simplex{vertex(at)};
    for (int step = 0; step < D; ++step) {
      ++at[order[step]];
      simplex[step + 1] = vertex(at);
    }
    int inversions = 0;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < a; ++b) inversions += order[b] > order[a];
    if (inversions % 2 != 0)
      std::swap(simplex[D - 1], simplex[D]);  // an odd order turns the simplex inside out
    simplices.push_back(simplex);
  } while (std::ranges::next_permutation(order).found);
}

template <int D>
void fill_box(const std::array<double, D>& lengths, const std::array<int, D>& cells, Mesh& mesh,
              std::vector<std::array<int, D + 1>>& simplices) {
  int vertices = 1;
  for (int axis = 0; axis < D; ++axis) {
    if (!(lengths[axis] > 0)) throw std::invalid_argument("box: lengths must be > 0");
    if (cells[axis] < 1) throw std::invalid_argument("box: cells must be >= 1");
    vertices *= cells[axis] + 1;
  }
  const auto vertex = [&](const std::array<int, D>& at) {
    int number = 0;
    for (int axis = 0; axis < D; ++axis) number = number * (cells[axis] + 1) + at[axis];
    return number;
  };
  mesh.position.resize(vertices, D);
  for (int v = 0; v < vertices; ++v) {
    std::array<int, D> at{};
    int rest = v;
    bool begins_a_cell = true;
    for (int axis = D - 1; axis >= 0; --axis) {
      at[axis] = rest % (cells[axis] + 1);
      rest /= cells[axis] + 1;
      mesh.position(v, axis) = lengths[axis] * at[axis] / cells[axis];
      begins_a_cell = begins_a_cell && at[axis] < cells[axis];
    }
    if (begins_a_cell) cut<D>(at, vertex, simplices);
  }
  mesh.edges = edges_of(mesh.tetrahedra, mesh.triangles);
}

}  // namespace

Mesh box(const std::array<double, 3>& lengths, const std::array<int, 3>& cells) {
  Mesh mesh;
  fill_box<3>(lengths, cells, mesh, mesh.tetrahedra);
  return mesh;
}

Mesh rectangle(const std::array<double, 2>& lengths, const std::array<int, 2>& cells) {
  Mesh mesh;
  fill_box<2>(lengths, cells, mesh, mesh.triangles);
  return mesh;
}

}  // namespace jetlag
