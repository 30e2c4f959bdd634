// SPDX-License-Identifier: MIT
// Of a homogeneous deformation x = F X all elements have J = det F and the stretches of F.
#include "jetlag/output/deformation.hpp"

#include <gmock/gmock.h>

#include "jetlag/scenes/mesh.hpp"

namespace jetlag::testing::deformation_test {
namespace {

template <std::size_t P>
Solid solid_of(const std::vector<std::array<int, P>>& cells, double thickness = 1) {
  Solid solid{"rubber", {}, thickness};
  for (const auto& cell : cells) solid.cells.insert(solid.cells.end(), cell.begin(), cell.end());
  return solid;
}

/// F = R diag(3, 1/2, 4/5): J = 6/5, stretches 3, 1/2, 4/5 whatever R. computeDirect finds them to some 1e-8 of the largest.
TEST(Deformation, OfABodyIsThatOfItsElements) {
  const Mesh mesh = box({1, 2, 3}, {2, 1, 1});
  DeformationMeter meter({solid_of(mesh.tetrahedra)}, mesh.position);
  const Eigen::Matrix3d f = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).matrix() *
                            Eigen::Vector3d(3, 0.5, 0.8).asDiagonal();
  meter.take(0.25, mesh.position * f.transpose());
  const Deformation& found = meter.found()[0];
  EXPECT_EQ(found.law, "rubber");
  EXPECT_EQ(found.count, 12u);
  EXPECT_NEAR(found.volume, 6, 1e-14);
  EXPECT_NEAR(found.min_j, 1.2, 1e-14);
  EXPECT_NEAR(found.max_stretch, 3, 3e-7);
  EXPECT_EQ(found.inverted, 0u);
}

TEST(Deformation, RemembersTheWorstElementOfAllFrames) {
  const Mesh mesh = box({1, 1, 1}, {1, 1, 1});
  DeformationMeter meter({solid_of(mesh.tetrahedra)}, mesh.position);
  Coordinates<double> pushed = mesh.position;
  meter.take(0, pushed);
  EXPECT_NEAR(meter.found()[0].min_j, 1, 1e-15);
  pushed(0, 0) = 1.5;  // the lowest corner goes through the far side of those elements that it is a corner of
  meter.take(1, pushed);
  meter.take(2, mesh.position);
  const Deformation& found = meter.found()[0];
  double least = 1;
  std::size_t inverted = 0;
  std::array<int, 4> worst{};
  for (const auto& t : mesh.tetrahedra) {
    const double j = six_volumes(pushed, t) / six_volumes(mesh.position, t);
    inverted += j <= 0;
    if (j < least - 1e-12) worst = t;
    least = std::min(least, j);
  }
  EXPECT_LT(least, 0);
  EXPECT_NEAR(found.min_j, least, 1e-15);
  EXPECT_EQ(found.min_j_time, 1);
  EXPECT_THAT(found.min_j_element, ::testing::ElementsAreArray(worst));
  EXPECT_EQ(found.inverted, inverted);
}

TEST(Deformation, CountsSolidsOfOneLawTogetherAndOthersApart) {
  const Mesh mesh = rectangle({2, 1}, {1, 1});
  const Solid one = solid_of<3>({mesh.triangles[0]}, 0.1), two = solid_of<3>({mesh.triangles[1]}, 0.1);
  Solid other = one;
  other.law = "stone";
  DeformationMeter meter({one, other, two}, mesh.position);
  meter.take(0, mesh.position * Eigen::Vector2d(1, -2).asDiagonal());
  ASSERT_EQ(meter.found().size(), 2u);
  EXPECT_EQ(meter.found()[0].count, 2u);
  EXPECT_NEAR(meter.found()[0].volume, 0.2, 1e-16);
  EXPECT_EQ(meter.found()[0].inverted, 2u);
  EXPECT_NEAR(meter.found()[0].min_j, -2, 1e-15);
  EXPECT_NEAR(meter.found()[0].max_stretch, 2, 2e-7);
  EXPECT_EQ(meter.found()[1].count, 1u);
  EXPECT_THAT(meter.found()[1].min_j_element, ::testing::ElementsAreArray(mesh.triangles[0]));
}

}  // namespace
}  // namespace jetlag::testing::deformation_test
