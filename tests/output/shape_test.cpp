// SPDX-License-Identifier: MIT
#include "jetlag/output/shape.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ContainerEq;
using ::testing::SizeIs;

Eigen::Vector3d at(const Coordinates<double>& position, int i) { return position.row(i); }

/// The six times the volume inside a closed surface, by the divergence theorem: sum of a . (b x c).
double six_volumes(const std::vector<std::array<int, 3>>& surface, const Coordinates<double>& position) {
  double sum = 0;
  for (const auto& [a, b, c] : surface) sum += at(position, a).dot(at(position, b).cross(at(position, c)));
  return sum;
}

/// The triangles, each beginning with its least corner: the same set for the same oriented surface.
std::set<std::array<int, 3>> corners(const std::vector<std::array<int, 3>>& surface) {
  std::set<std::array<int, 3>> triangles;
  for (auto triangle : surface) {
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    triangles.insert(triangle);
  }
  return triangles;
}

/// A box whose particles were moved a little at random: no tetrahedron turns over.
struct CrookedBox {
  CrookedBox() : shape(box(3, 4, 5, position)) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-0.01, 0.01);
    for (double& x : position.reshaped()) x += 1.0 + shift(random);
  }
  Coordinates<double> position;
  Shape shape;
};

TEST(Boundary, HasEachOuterFaceOnce) {
  const CrookedBox box;
  EXPECT_THAT(box.shape.surface, SizeIs(2 * 2 * (3 * 4 + 4 * 5 + 5 * 3)));
  std::set<std::set<int>> faces;
  for (const auto& [a, b, c] : box.shape.surface) faces.insert({a, b, c});
  EXPECT_THAT(faces, SizeIs(box.shape.surface.size()));
}

TEST(Boundary, PassesEachEdgeOnceInEachDirection) {
  const CrookedBox box;
  std::map<std::pair<int, int>, int> passed;
  for (const auto& [a, b, c] : boundary(box.shape.tetrahedra, box.position))
    ++passed[{a, b}], ++passed[{b, c}], ++passed[{c, a}];
  for (const auto& [edge, times] : passed) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ(passed.count({edge.second, edge.first}), 1);
  }
}

TEST(Boundary, EnclosesTheVolumeOfTheTetrahedra) {
  const CrookedBox box;
  double sum = 0;
  for (const auto& [a, b, c, d] : box.shape.tetrahedra) {
    const Eigen::Vector3d o = at(box.position, a);
    sum += std::abs((at(box.position, b) - o).dot((at(box.position, c) - o).cross(at(box.position, d) - o)));
  }
  // 188 terms of size 1 (the box is about 1 m from the origin), each within a few ulps.
  EXPECT_NEAR(six_volumes(boundary(box.shape.tetrahedra, box.position), box.position), sum, 1e-12);
  EXPECT_GT(sum, 0.0);
}

TEST(Boundary, DoesNotDependOnTheWindingOfTheTetrahedra) {
  const CrookedBox box;
  auto turned = box.shape.tetrahedra;
  for (auto& tetrahedron : turned) std::swap(tetrahedron[1], tetrahedron[2]);
  EXPECT_THAT(corners(boundary(turned, box.position)), ContainerEq(corners(box.shape.surface)));
}

TEST(Boundary, RefusesWhatDoesNotExist) {
  Coordinates<double> position = Coordinates<double>::Identity(4, 3);
  EXPECT_THROW(boundary({{0, 1, 2, 4}}, position), std::invalid_argument);
  EXPECT_THROW(boundary({{0, 1, 2, -1}}, position), std::invalid_argument);
  EXPECT_THROW(boundary({{0, 1, 2, 3}}, position.leftCols(2)), std::invalid_argument);
  EXPECT_THAT(boundary({}, position), SizeIs(0));
}

}  // namespace
}  // namespace jetlag::testing
