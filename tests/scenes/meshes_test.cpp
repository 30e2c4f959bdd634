// SPDX-License-Identifier: MIT
// Meshes that are generated, and the Medit reader.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "jetlag/model/hinges.hpp"
#include "jetlag/output/shape.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

/// Of a body without holes: vertices - edges + faces - tetrahedra = 1 (Euler, Poincare).
int euler_number(const Mesh& mesh) {
  std::set<std::array<int, 3>> faces;
  for (const auto& t : mesh.tetrahedra)
    for (int left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face;
      for (int c = 0, i = 0; c < 4; ++c)
        if (c != left_out) face[i++] = t[c];
      std::sort(face.begin(), face.end());
      faces.insert(face);
    }
  return static_cast<int>(mesh.position.rows()) - static_cast<int>(mesh.edges.size()) +
         static_cast<int>(faces.size()) - static_cast<int>(mesh.tetrahedra.size());
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra) sum += six_volumes(mesh.position, t) / 6;
  return sum;
}

/// Volume between two planes: pi a c integral of (1 - f^2) b df.
double truncated_volume(double a, double b, double c, double lower, double upper) {
  return std::numbers::pi * a * b * c * ((upper + lower) - (std::pow(upper, 3) + std::pow(lower, 3)) / 3);
}

TEST(Box, IsKuhnsMesh) {
  const Mesh mesh = box({2.0, 3.0, 4.0}, {2, 3, 4});
  ASSERT_EQ(mesh.position.rows(), 60);
  EXPECT_EQ(mesh.position.row((1 * 4 + 2) * 5 + 3), Eigen::RowVector3d(1, 2, 3));
  ASSERT_EQ(mesh.tetrahedra.size(), 144u);
  for (const auto& t : mesh.tetrahedra) {  // from corner to opposite corner, of a sixth of the cell each
    const auto far = mesh.position.row(*std::max_element(t.begin(), t.end()));
    EXPECT_EQ(Eigen::RowVector3d(far - mesh.position.row(t[0])), Eigen::RowVector3d::Ones());
    EXPECT_EQ(six_volumes(mesh.position, t), 1.0);
  }
  EXPECT_EQ(euler_number(mesh), 1);
  EXPECT_EQ(boundary(mesh.tetrahedra, mesh.position).size(), 2u * 2 * (6 + 8 + 12));
}

TEST(Rectangle, IsCutAlongItsDiagonals) {
  const Mesh mesh = rectangle({2.0, 3.0}, {2, 3});
  ASSERT_EQ(mesh.position.rows(), 12);
  EXPECT_EQ(mesh.position.row(1 * 4 + 2), Eigen::RowVector2d(1, 2));
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (const auto& [a, b, c] : mesh.triangles) {  // counterclockwise, half of a cell each
    const Eigen::RowVector2d ab = mesh.position.row(b) - mesh.position.row(a),
                             ac = mesh.position.row(c) - mesh.position.row(a);
    EXPECT_EQ(ab[0] * ac[1] - ab[1] * ac[0], 1.0);
  }
  EXPECT_EQ(mesh.edges.size(), 2u * 4 + 3u * 3 + 6u);
  EXPECT_THROW(rectangle({2.0, 0.0}, {2, 3}), std::invalid_argument);
  EXPECT_THROW(rectangle({2.0, 1.0}, {2, 0}), std::invalid_argument);
}

TEST(TruncatedEllipsoid, IsFilledWithoutGapsOrOverlaps) {
  const Mesh mesh = truncated_ellipsoid({0.7, 1.2, 0.8}, {8, 8}, 0.95, 0.8);
  EXPECT_EQ(mesh.position.rows(), 9 * 9 * 9);
  EXPECT_EQ(mesh.tetrahedra.size(), 6u * 8 * 8 * 8);
  for (const auto& t : mesh.tetrahedra) ASSERT_GT(six_volumes(mesh.position, t), 0);
  EXPECT_EQ(euler_number(mesh), 1);
  // Tetrahedra that neither overlap nor leave gaps have the volume within their boundary (divergence theorem).
  double enclosed = 0;
  for (const auto& [a, b, c] : boundary(mesh.tetrahedra, mesh.position)) {
    const Eigen::Vector3d p = mesh.position.row(a), q = mesh.position.row(b), r = mesh.position.row(c);
    enclosed += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                 p[2] * (q[0] * r[1] - q[1] * r[0])) /
                6;
  }
  EXPECT_NEAR(enclosed, volume(mesh), 1e-13);  // some 1e3 terms below 1e-2, each rounded to 1e-18
}

TEST(TruncatedEllipsoid, VolumeConvergesAsTheSquareOfTheCellSize) {
  const double exact = truncated_volume(0.7, 1.2, 0.8, 0.9, 0.8);
  const auto missing = [&](int n) {
    return exact - volume(truncated_ellipsoid({0.7, 1.2, 0.8}, {n, n}, 0.9, 0.8));
  };
  EXPECT_NEAR(missing(8) / missing(16), 4.0, 0.2);  // a surface of chords lies h^2/8 inside; next term is h^4
}

TEST(TruncatedEllipse, HasTheAreaOfItsChords) {
  const Mesh mesh = truncated_ellipse({2.0, 1.2}, {20, 400}, 0.85, 0.95);
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector2d p = mesh.position.row(b) - mesh.position.row(a),
                          q = mesh.position.row(c) - mesh.position.row(a);
    const double twice = p[0] * q[1] - p[1] * q[0];
    ASSERT_GT(twice, 0);
    area += twice / 2;
  }
  const auto primitive = [](double f) { return 0.5 * (f * std::sqrt(1 - f * f) + std::asin(f)); };
  const double exact = 2 * 2.0 * 1.2 * (primitive(0.95) + primitive(0.85));
  EXPECT_NEAR(area / exact, 1,
              1e-5);  // trapezoids of 400 slices: (1.8/400)^2/12 times the mean curvature, about 2
}

TEST(RegularGrid, JoinsNeighbours) {
  EXPECT_EQ(regular_grid({5, 4}, 0.1, 3, false).edges.size(), 4u * 4 + 5u * 3);
  // structural 31, both diagonals of 12 cells, and every second along rows and columns
  EXPECT_EQ(regular_grid({5, 4}, 0.1, 3, true).edges.size(), 31u + 2u * 12 + 3u * 4 + 5u * 2);
  const Mesh mesh = regular_grid({5, 4}, 0.1, 3, true);
  std::set<double> lengths;
  for (const auto& [a, b] : mesh.edges)
    lengths.insert(std::round(1e6 * (mesh.position.row(a) - mesh.position.row(b)).norm()) / 1e6);
  EXPECT_EQ(lengths, (std::set<double>{0.1, 0.141421, 0.2}));
  EXPECT_EQ(std::set(mesh.edges.begin(), mesh.edges.end()).size(), mesh.edges.size());
}

TEST(Sheet, IsFilledWithTrianglesThatAreSeenFromAbove) {
  for (const auto pattern : {SheetPattern::equilateral, SheetPattern::crisscross, SheetPattern::uniform}) {
    const Mesh mesh = sheet({2.0, 1.5}, {5, 3}, pattern);
    EXPECT_EQ(mesh.position.rows(), 6 * 4);
    EXPECT_EQ(mesh.triangles.size(), 2u * 5 * 3);
    EXPECT_EQ(mesh.edges.size(), 5u * 4 + 6u * 3 + 5u * 3);
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d p = mesh.position.row(b) - mesh.position.row(a),
                            q = mesh.position.row(c) - mesh.position.row(a);
      EXPECT_EQ(p[2], 0);
      EXPECT_GT(p[0] * q[1] - p[1] * q[0], 0);
      area += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    EXPECT_NEAR(area, 3.0, 3.0 * 30 * 0x1p-52);  // the sides are zigzags, what is lost here is won there
    EXPECT_EQ(hinges_of(mesh.triangles).size(), mesh.edges.size() - 2 * (5 + 3));  // all but the border
  }
}

TEST(Sheet, HasTheCornersOfItsPattern) {
  const Mesh shifted = sheet({4.0, std::sqrt(3.0)}, {4, 2}, SheetPattern::equilateral);
  for (const auto& [a, b] : shifted.edges)  // equal sides, of numbers near 4
    EXPECT_NEAR((shifted.position.row(a) - shifted.position.row(b)).norm(), 1.0, 8 * 0x1p-52);
  EXPECT_EQ(shifted.position(4 * 3 + 1, 0), 4.5);
  const Mesh uniform = sheet({4.0, 3.0}, {4, 3}, SheetPattern::uniform),
             crisscross = sheet({4.0, 3.0}, {4, 3}, SheetPattern::crisscross);
  EXPECT_EQ(uniform.position.row(2 * 4 + 1), Eigen::RowVector3d(2, 1, 0));
  std::vector<int> joined(20), joined_alternately(20);
  for (const auto& [a, b] : uniform.edges) ++joined[a], ++joined[b];
  for (const auto& [a, b] : crisscross.edges) ++joined_alternately[a], ++joined_alternately[b];
  EXPECT_EQ(joined[1 * 4 + 1], 6);
  EXPECT_EQ(joined[1 * 4 + 2], 6);
  EXPECT_EQ(joined_alternately[1 * 4 + 1] + joined_alternately[1 * 4 + 2], 8 + 4);
}

TEST(Sheet, IsRefusedWithoutCellsOrLengths) {
  EXPECT_THROW(sheet({1.0, 0.0}, {1, 1}, SheetPattern::uniform), std::invalid_argument);
  EXPECT_THROW(sheet({1.0, std::numeric_limits<double>::quiet_NaN()}, {1, 1}, SheetPattern::uniform),
               std::invalid_argument);
  EXPECT_THROW(sheet({1.0, 1.0}, {1, 0}, SheetPattern::uniform), std::invalid_argument);
}

TEST(Medit, ReadsWhatAnotherProgramWrote) {
  const TemporaryFolder folder;
  write(folder / "two.mesh",
        "MeshVersionFormatted 2\n# a comment\nDimension\n3\n\nVertices 5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 "
        "1.5e0 1 # apex\n"
        "1 1 1 7\nTriangles\n1\n1 2 3 4\nTetrahedra\n2\n1 2 3 4 0\n2 3 4 5 0\nEnd\n");
  const Mesh mesh = read_medit(folder / "two.mesh");
  EXPECT_EQ(mesh.position.rows(), 5);
  EXPECT_EQ(mesh.position(3, 2), 1.5);
  EXPECT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_EQ(mesh.edges.size(), 9u);  // two tetrahedra that share a face
}

TEST(Medit, ReadsTheBunny) {
  const std::filesystem::path bunny = std::filesystem::path(JETLAG_SHARED_DIR) / "meshes/coarse_bunny.mesh";
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << "needs " << bunny;
  const Mesh mesh = read_medit(bunny);
  EXPECT_EQ(mesh.position.rows(), 699);
  EXPECT_EQ(mesh.tetrahedra.size(), 2274u);
  EXPECT_EQ(mesh.edges.size(), 3521u);
  double shortest = 1e9, longest = 0;
  for (const auto& [a, b] : mesh.edges) {
    const double length = (mesh.position.row(a) - mesh.position.row(b)).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  EXPECT_NEAR(shortest, 1.948030, 1e-6);
  EXPECT_NEAR(longest, 38.615988, 1e-6);
  EXPECT_EQ((mesh.position.col(1).array() <= mesh.position.col(1).minCoeff() + 3.0).count(), 17);
}

}  // namespace
}  // namespace jetlag::testing
