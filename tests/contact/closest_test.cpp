// SPDX-License-Identifier: MIT
// Closest points of stencils: what their weights keep, and against the minimum over all features.

#include "jetlag/contact/closest.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "support/random.hpp"

namespace jetlag::testing::closest_test {
namespace {

using ::testing::ElementsAre;
using Vector = Eigen::Vector3d;
using Points = std::vector<Vector>;
using enum StencilKind;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr StencilKind kinds[] = {vertex_vertex, vertex_edge, vertex_face, edge_edge};

Points random_points(StencilKind kind, Uniform& random) {
  Points x(vertices_of(kind));
  for (Vector& point : x)
    for (double& component : point) component = random(-1, 1);
  return x;
}

/// The smallest distance of two convex hulls by going through all pairs of features: the closest points of their planes,
/// lines and points (least squares), where those lie within the features. Some pair holds the minimum.
double smallest_distance(StencilKind kind, const Points& x) {
  const int a = first_side(kind), all = vertices_of(kind);
  double least = std::numeric_limits<double>::infinity();
  for (unsigned set = 1; set < 1U << all; ++set) {
    std::vector<int> side[2];
    for (int i = 0; i < all; ++i)
      if (set >> i & 1U) side[i >= a].push_back(i);
    if (side[0].empty() || side[1].empty()) continue;
    const int p = side[0][0], q = side[1][0];
    Eigen::MatrixXd edges(3, side[0].size() + side[1].size() - 2);
    int column = 0;
    for (const int i : side[0])
      if (i != p) edges.col(column++) = x[i] - x[p];
    for (const int i : side[1])
      if (i != q) edges.col(column++) = x[q] - x[i];
    Vector way = x[p] - x[q];
    bool inside = true;
    if (column > 0) {
      const Eigen::VectorXd part = edges.colPivHouseholderQr().solve(-way);
      const auto first = part.head(side[0].size() - 1), second = part.tail(side[1].size() - 1);
      inside = part.minCoeff() >= 0 && first.sum() <= 1 && second.sum() <= 1;
      way += edges * part;
    }
    if (inside) least = std::min(least, way.norm());
  }
  return least;
}

Vector weighted_sum(const Closest& near, const Points& x) {
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) sum += near.b[i] * x[i];
  return sum;
}

std::set<int> vertices(const Closest& near) {
  return {near.vertices.begin(), near.vertices.begin() + vertices_of(near.region)};
}

TEST(Closest, WeightsAddUpToNothingAndTurnNothing) {
  // Weights are multiples of 2^-52 of at most 1: sums are exact. x_i x b_i n: four terms of size <= sqrt(3), each rounded
  // some five times, and the way itself, rounded by some eps, turned against n by that over d >= 0.05: 4e-15 asked for.
  for (const StencilKind kind : kinds) {
    Uniform random(1);
    double turn = 0;
    for (int k = 0; k < 100'000; ++k) {
      const Points x = random_points(kind, random);
      const Closest near = closest(kind, x);
      ASSERT_EQ(near.b[0] + near.b[1] + near.b[2] + near.b[3], 0) << "seed 1, stencil " << k;
      ASSERT_EQ(near.b[3] + near.b[1] + near.b[2] + near.b[0], 0) << "seed 1, stencil " << k;
      if (near.distance < 0.05) continue;
      Vector sum = Vector::Zero();
      for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].cross(near.b[i] * near.way / near.distance);
      turn = std::max(turn, sum.norm());
    }
    EXPECT_LE(turn, 4e-15) << static_cast<int>(kind);
  }
}

TEST(Closest, WeightsSayWhichVerticesTheRegionHas) {
  for (const StencilKind kind : kinds) {
    Uniform random(2);
    std::set<std::set<int>> seen;
    for (int k = 0; k < 20'000; ++k) {
      const Closest near = closest(kind, random_points(kind, random));
      const std::set<int> region = vertices(near);
      seen.insert(region);
      for (int i = 0; i < 4; ++i) {
        const bool is_first = i < first_side(kind);
        ASSERT_EQ(near.b[i] != 0, region.contains(i)) << "seed 2, stencil " << k;
        ASSERT_TRUE(is_first ? near.b[i] >= 0 : near.b[i] <= 0) << "seed 2, stencil " << k;
      }
      for (int i = vertices_of(near.region); i < 4; ++i) ASSERT_EQ(near.vertices[i], -1);
    }
    EXPECT_EQ(seen.size(), (std::vector<std::size_t>{1, 3, 7, 9}[static_cast<int>(kind)]));
  }
}

TEST(Closest, IsTheSameInItsRegion) {
  // The stencil that the region names has the same closest points, with the sides exchanged where its first vertex is of
  // side B. The same operations give the same bits.
  for (const StencilKind kind : kinds) {
    Uniform random(3);
    for (int k = 0; k < 2'000; ++k) {
      const Points x = random_points(kind, random);
      const Closest near = closest(kind, x);
      Points part;
      for (const int i : vertices(near)) part.push_back(x[i]);
      if (near.region == vertex_edge)
        for (int i = 0; i < 3; ++i) part[i] = x[near.vertices[i]];
      const Closest again = closest(near.region, part);
      const bool exchanged = near.vertices[0] >= first_side(kind);
      ASSERT_EQ(again.region, near.region) << "seed 3, stencil " << k;
      ASSERT_EQ(again.way, exchanged ? Vector(-near.way) : near.way) << "seed 3, stencil " << k;
      for (std::size_t i = 0; i < part.size(); ++i)
        ASSERT_EQ(again.b[i], (exchanged ? -1 : 1) * near.b[near.vertices[i]]) << "seed 3, stencil " << k;
    }
  }
}

TEST(Closest, HasTheSmallestDistance) {
  // Both round some ten times at sizes up to 2 sqrt(3); where edges are nearly parallel the places move along them by the
  // rounding over the sine, and d by its square.
  for (const StencilKind kind : kinds) {
    Uniform random(4);
    for (int k = 0; k < 25'000; ++k) {
      const Points x = random_points(kind, random);
      const Closest near = closest(kind, x);
      ASSERT_NEAR(near.distance, smallest_distance(kind, x), 1e-14) << "seed 4, stencil " << k;
      ASSERT_LE((weighted_sum(near, x) - near.way).norm(), 20 * eps) << "seed 4, stencil " << k;
      ASSERT_EQ(near.distance, near.way.norm());
    }
  }
}

TEST(Closest, HasTheGradientOfTheDistance) {
  // Central differences over 2e are rounded by some 4 eps / e = 9e-10 and off by e^2/6 of the third derivative, about
  // 1 / (d l)^2 where l >= 0.01 is the height of a thin face: 1e-6 at the worst, 2e-7 for the stencils of this seed. Where
  // they reach over a switch of regions, the second derivative jumps by about 1 / d there: e / d.
  const double e = 1e-6;
  for (const StencilKind kind : kinds) {
    Uniform random(5);
    for (int k = 0; k < 100'000; ++k) {
      Points x = random_points(kind, random);
      const Closest near = closest(kind, x);
      if (near.distance < 0.05) continue;
      const int i = k % vertices_of(kind), c = k / 4 % 3;
      const double middle = x[i][c];
      x[i][c] = middle + e;
      const Closest after = closest(kind, x);
      x[i][c] = middle - e;
      const Closest before = closest(kind, x);
      const double slope = (after.distance - before.distance) / (2 * e);
      const double most = before.vertices == after.vertices ? 2e-7 : e / near.distance;
      ASSERT_NEAR(slope, near.b[i] * near.way[c] / near.distance, most)
          << "seed 5, stencil " << k << " of kind " << static_cast<int>(kind);
    }
  }
}

TEST(Closest, TakesTheSmallerRegionOnBorders) {
  const Vector a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto face = [&](double x, double y) { return closest(vertex_face, Points{{x, y, 0.5}, a, b, c}); };
  EXPECT_THAT(face(0, 0).vertices, ElementsAre(0, 1, -1, -1));
  EXPECT_THAT(face(1, 0).vertices, ElementsAre(0, 2, -1, -1));
  EXPECT_THAT(face(0, 1).vertices, ElementsAre(0, 3, -1, -1));
  EXPECT_THAT(face(0, -1).vertices, ElementsAre(0, 1, -1, -1));
  EXPECT_THAT(face(0.25, 0).vertices, ElementsAre(0, 1, 2, -1));
  EXPECT_THAT(face(0, 0.25).vertices, ElementsAre(0, 1, 3, -1));
  EXPECT_THAT(face(0.25, 0.75).vertices, ElementsAre(0, 2, 3, -1));
  EXPECT_THAT(face(0.25, 0.25).vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(face(0.25, 0.5).b, ElementsAre(1, -0.25, -0.25, -0.5));

  const auto edge = [&](double x) { return closest(vertex_edge, Points{{x, 0.5, 0}, a, b}).vertices; };
  EXPECT_THAT(edge(0), ElementsAre(0, 1, -1, -1));
  EXPECT_THAT(edge(1), ElementsAre(0, 2, -1, -1));
  EXPECT_THAT(edge(0x1p-40), ElementsAre(0, 1, 2, -1));

  // The edge from a to b, and one across above it, from (x, y) on to y + 1.
  const auto across = [&](double x, double y) {
    return closest(edge_edge, Points{a, b, {x, y, 0.5}, {x, y + 1, 0.5}});
  };
  EXPECT_THAT(across(0, 0).vertices, ElementsAre(0, 2, -1, -1));
  EXPECT_THAT(across(1, -1).vertices, ElementsAre(1, 3, -1, -1));
  EXPECT_THAT(across(1, -0.5).vertices, ElementsAre(1, 2, 3, -1));
  EXPECT_THAT(across(0.5, 0).vertices, ElementsAre(2, 0, 1, -1));
  EXPECT_THAT(across(0.5, -1).vertices, ElementsAre(3, 0, 1, -1));
  EXPECT_THAT(across(0.25, -0.75).vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(across(0.25, -0.75).b, ElementsAre(0.75, 0.25, -0.25, -0.75));
  EXPECT_EQ(across(0.25, -0.75).way, Vector(0, 0, -0.5));
}

TEST(Closest, OfParallelEdgesLiesInTheMiddleOfTheOverlap) {
  const auto beside = [](double first, double last) {
    return closest(edge_edge, Points{{0, 0, 0}, {1, 0, 0}, {first, 0, 0.5}, {last, 0, 0.5}});
  };
  EXPECT_THAT(beside(0, 1).b, ElementsAre(0.5, 0.5, -0.5, -0.5));
  EXPECT_THAT(beside(1, 0).b, ElementsAre(0.5, 0.5, -0.5, -0.5));
  EXPECT_THAT(beside(0.5, 1.5).b, ElementsAre(0.25, 0.75, -0.75, -0.25));
  EXPECT_THAT(beside(0.5, -1.5).b, ElementsAre(0.75, 0.25, -0.875, -0.125));
  EXPECT_THAT(beside(0.25, 0.5).b, ElementsAre(0.625, 0.375, -0.5, -0.5));
  EXPECT_THAT(beside(-1, 3).b, ElementsAre(0.5, 0.5, -0.625, -0.375));
  for (const auto& near : {beside(0, 1), beside(0.5, -1.5)}) {
    EXPECT_EQ(near.region, edge_edge);
    EXPECT_EQ(near.way, Vector(0, 0, -0.5));
  }
  // Beside each other in one point or nowhere: ends.
  EXPECT_THAT(beside(1, 2).vertices, ElementsAre(1, 2, -1, -1));
  EXPECT_THAT(beside(2, 1).vertices, ElementsAre(1, 3, -1, -1));
  EXPECT_THAT(beside(-1, 0).vertices, ElementsAre(0, 3, -1, -1));
  EXPECT_THAT(beside(-2, -3).vertices, ElementsAre(0, 2, -1, -1));
  EXPECT_EQ(beside(2, 3).way, Vector(-1, 0, -0.5));
}

TEST(Closest, OfEdgesTurnedByRoundingLiesInTheMiddleToo) {
  for (const double angle : {1e-9, -1e-9, 1e-15}) {
    const auto near = closest(edge_edge, Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0.5}, {1, angle, 0.5 + angle}});
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(near.b[i], i < 2 ? 0.5 : -0.5, 2e-9) << angle;
  }
}

TEST(Closest, OfNearlyParallelEdgesIsNotFarFromTheSmallest) {
  // One edge turned against the other by an angle on either side of the limit 1e-6: d is within 1e-6 |e| of the smallest.
  Uniform random(6);
  for (const double angle : {1e-3, 1e-5, 1.1e-6, 0.9e-6, 1e-7, 1e-9, 1e-15})
    for (int k = 0; k < 1'000; ++k) {
      Points x = random_points(edge_edge, random);
      const Vector p = x[1] - x[0], turned = random_points(vertex_vertex, random)[0];
      x[3] = x[2] + random(-2, 2) * (p + angle * p.norm() * p.cross(turned).normalized());
      const double excess = closest(edge_edge, x).distance - smallest_distance(edge_edge, x);
      const double most = angle > 1e-6 ? 1e-13 : 1.0001 * angle * p.norm();
      ASSERT_LE(excess, most) << "seed 6, edges " << k << " at " << angle;
    }
}

TEST(Closest, IsDefinedForEdgesAndFacesWithoutSize) {
  const Vector a(0, 0, 0), b(1, 0, 0), c(0.25, 0, 0), p(0.5, 1, 0);
  EXPECT_THAT(closest(vertex_edge, Points{p, a, a}).vertices, ElementsAre(0, 1, -1, -1));
  EXPECT_EQ(closest(vertex_face, Points{p, a, b, c}).distance, 1);
  EXPECT_EQ(closest(vertex_face, Points{p, a, a, a}).way, p);
  EXPECT_EQ(closest(vertex_face, Points{p, a, a, b}).way, Vector(0, 1, 0));
  EXPECT_EQ(closest(edge_edge, Points{p, p, a, b}).way, Vector(0, 1, 0));
  EXPECT_EQ(closest(edge_edge, Points{a, b, p, p}).way, Vector(0, -1, 0));
  EXPECT_THAT(closest(edge_edge, Points{p, p, a, b}).vertices, ElementsAre(0, 2, 3, -1));
  EXPECT_THAT(closest(edge_edge, Points{a, b, p, p}).vertices, ElementsAre(2, 0, 1, -1));
  EXPECT_EQ(closest(edge_edge, Points{a, a, p, p}).way, -p);
  EXPECT_EQ(closest(vertex_vertex, Points{p, p}).distance, 0);
}

TEST(Closest, HasTheSmallestDistanceOfThinFaces) {
  // The third vertex near the line through the others, the point near it: signs are those of rounding, but only where either
  // answer is right, to some eps; in faces with angles below 1e-6 and beside them to eps over 1e-6, which is 2e-10.
  Uniform random(7);
  for (int k = 0; k < 100'000; ++k) {
    Points x = random_points(vertex_face, random);
    const double off = std::pow(10, random(-16, 0));
    x[3] = x[1] + random(-1.5, 1.5) * (x[2] - x[1]) + (k % 2) * off * x[3];
    x[0] = x[1] + random(-1, 1) * (x[2] - x[1]) + (k % 3 > 0 ? off : 0) * x[0];
    ASSERT_NEAR(closest(vertex_face, x).distance, smallest_distance(vertex_face, x),
                k % 2 == 1 && off > 1e-5 ? 1e-14 : 2e-10)
        << "seed 7, face " << k;
  }
}

TEST(Closest, HasTheSmallestDistanceOnAGrid) {
  // All ways of lying on borders, in planes and on each other; what is decided is decided by exact numbers.
  for (const StencilKind kind : kinds) {
    Uniform random(9);
    for (int k = 0; k < 50'000; ++k) {
      Points x = random_points(kind, random);
      for (Vector& point : x)
        for (double& component : point) component = std::round(1.5 * component);
      ASSERT_NEAR(closest(kind, x).distance, smallest_distance(kind, x), 1e-14) << "seed 9, stencil " << k;
    }
  }
}

TEST(Closest, KeepsItsDigitsFarFromTheOrigin) {
  // Positions are multiples of 2^-30, so that adding 1e6 is exact, and so are their differences: the same bits.
  for (const StencilKind kind : kinds) {
    Uniform random(8);
    for (int k = 0; k < 1'000; ++k) {
      Points x = random_points(kind, random);
      for (Vector& point : x)
        for (double& component : point) component = std::round(component * 0x1p30) * 0x1p-30;
      const Closest near = closest(kind, x);
      for (Vector& point : x) point += Vector(1e6, -1e6, 1e6);
      const Closest far = closest(kind, x);
      ASSERT_EQ(near.b, far.b) << "seed 8, stencil " << k;
      ASSERT_EQ(near.way, far.way) << "seed 8, stencil " << k;
      ASSERT_EQ(near.vertices, far.vertices);
    }
  }
}

}  // namespace
}  // namespace jetlag::testing::closest_test
