// SPDX-License-Identifier: MIT
// The first time at which a stencil comes within a distance, against sampled distances and known motions.

#include "jetlag/contact/approach.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "jetlag/series/calculus/polynomial.hpp"
#include "support/random.hpp"

namespace jetlag::testing::approach_test {
namespace {

using Vector = Eigen::Vector3d;
using Path = std::vector<Vector>;  // c_0, c_1, ...
using Motion = std::vector<Path>;  // of each vertex
using enum StencilKind;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr StencilKind kinds[] = {vertex_vertex, vertex_edge, vertex_face, edge_edge};

std::vector<PathView> views(const Motion& motion, double unit = 1) {
  std::vector<PathView> all;
  for (const Path& path : motion) all.push_back({path[0].data(), 3, static_cast<int>(path.size()) - 1, unit});
  return all;
}

std::optional<double> first(StencilKind kind, const Motion& motion, double h, double eta) {
  return Approach().first(kind, views(motion), h, eta);
}

double distance(StencilKind kind, const Motion& motion, double s) {
  std::vector<Vector> x;
  for (const Path& path : motion) {
    x.push_back(path.back());
    for (std::size_t k = path.size() - 1; k-- > 0;) x.back() = x.back() * s + path[k];
  }
  return closest(kind, x).distance;
}

/// Where a distance is smallest beside the middle of (low, high): by thirds.
double lowest_place(StencilKind kind, const Motion& motion, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool falls = distance(kind, motion, a) > distance(kind, motion, b);
    (falls ? low : high) = falls ? a : b;
  }
  return 0.5 * (low + high);
}

/// The first time in [0, 1] by 400 samples, by the lowest places where one is no higher than its neighbours, and by halving.
std::optional<double> first_by_samples(StencilKind kind, const Motion& motion, double eta) {
  constexpr int samples = 400;
  const auto d = [&](double s) { return distance(kind, motion, s); };
  std::vector<double> at;
  for (int i = 0; i <= samples; ++i) at.push_back(d(i / double(samples)));
  for (int i = 1; i <= samples; ++i) {
    double low = (i - 1) / double(samples), high = i / double(samples);
    if (at[i] > eta) {
      if (i == samples || at[i] > at[i - 1] || at[i] > at[i + 1] || at[i] > eta + 0.1) continue;
      high = lowest_place(kind, motion, low, (i + 1) / double(samples));
      if (d(high) > eta) continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (d(middle) <= eta ? high : low) = middle;
    }
    return high;
  }
  return std::nullopt;
}

/// Vertices in a cube of 1.6, side A above and falling, that move by some 1, with terms that decrease by 5 from order 2 on.
Motion random_motion(StencilKind kind, int degree, Uniform& random) {
  Motion motion(vertices_of(kind), Path(degree + 1));
  for (Path& path : motion)
    for (int k = 0; k <= degree; ++k)
      for (double& c : path[k]) c = random(-1, 1) * (k == 0 ? 0.8 : k == 1 ? 1.2 : std::pow(0.2, k - 1));
  for (int i = 0; i < first_side(kind); ++i) {
    motion[i][0][2] += 1;
    motion[i][1][2] -= 1;
  }
  return motion;
}

/// A vertex or an edge above the middle of the other side, in the plane z = 0, with the way -z.
Motion above_middle(StencilKind kind, double height) {
  Motion motion;
  if (kind == vertex_vertex) motion = {{{0, 0, 0}}, {{0, 0, 0}}};
  if (kind == vertex_edge) motion = {{{0, 0, 0}}, {{-1, 0, 0}}, {{1, 0, 0}}};
  if (kind == vertex_face) motion = {{{0, 0, 0}}, {{-1, -1, 0}}, {{1, -1, 0}}, {{0, 2, 0}}};
  if (kind == edge_edge) motion = {{{-1, 0, 0}}, {{1, 0, 0}}, {{0, -1, 0}}, {{0, 1, 0}}};
  for (int i = 0; i < first_side(kind); ++i) motion[i][0][2] = height;
  return motion;
}

/// Side A moves along z as the polynomial says, from its height on.
Motion moved(StencilKind kind, Motion motion, const std::vector<double>& z) {
  for (int i = 0; i < first_side(kind); ++i)
    for (const double c : z) motion[i].push_back({0, 0, c});
  return motion;
}

TEST(Approach, IsTheFirstThatSamplesFind) {
  // A hit is before the true time by at most 2^-30, and by what widening eta does: 4e-13 over the speed of approach. That
  // is below 1e-8 where the speed is above 1e-4.
  Approach approach;
  for (const int degree : {1, 8, 20})
    for (const StencilKind kind : kinds) {
      const double eta = kind == vertex_vertex ? 0.4 : kind == vertex_edge ? 0.2 : 0.1;
      Uniform random(1);
      int hits = 0;
      for (int k = 0; k < 1'000; ++k) {
        Motion motion = random_motion(kind, degree, random);
        while (distance(kind, motion, 0) <= 1.001 * eta) motion = random_motion(kind, degree, random);
        SCOPED_TRACE(::testing::Message() << "seed 1, kind " << static_cast<int>(kind) << ", degree "
                                          << degree << ", motion " << k);
        const auto truth = first_by_samples(kind, motion, eta);
        const auto found = approach.first(kind, views(motion), 1, eta);
        ASSERT_EQ(found.has_value(), truth.has_value());
        if (!truth) continue;
        ++hits;
        ASSERT_LE(*found, *truth + 1e-12);
        ASSERT_GE(*found, *truth - 2e-8);
      }
      EXPECT_GT(hits, 30) << static_cast<int>(kind);
    }
}

TEST(Approach, IsNeverMissedWhereTheDistanceIsSmallest) {
  // The smallest distance that a search finds is at least the true one, but for rounding: within it there is contact.
  // A thousandth below it there is none: the search has found the lowest of all places.
  for (const int degree : {1, 3, 12})
    for (const StencilKind kind : kinds) {
      Uniform random(2);
      for (int k = 0; k < 200; ++k) {
        const Motion motion = random_motion(kind, degree, random);
        double best = 0, least = distance(kind, motion, 0);
        for (int i = 1; i <= 200; ++i)
          if (const double d = distance(kind, motion, i / 200.0); d < least) best = i / 200.0, least = d;
        const double place =
            lowest_place(kind, motion, std::max(0.0, best - 0.005), std::min(1.0, best + 0.005));
        least = std::min(least, distance(kind, motion, place));
        if (least < 0.01) continue;
        ASSERT_TRUE(first(kind, motion, 1, least)) << "seed 2, motion " << k << " of degree " << degree;
        ASSERT_FALSE(first(kind, motion, 1, 0.999 * least)) << "seed 2, motion " << k;
        Motion far = motion;
        for (Path& path : far)
          path[0] += Vector(1e6, -1e6, 1e6);  // rounds by 1e-10, which the widening covers
        ASSERT_TRUE(first(kind, far, 1, least)) << "seed 2, motion " << k << " of degree " << degree;
      }
    }
}

TEST(Approach, OfAFallIsTheRootOfItsParabola) {
  // z = 1 - 2 s^2 is 0.02 at s = 0.7, inside of any stencil, in a step of 1 and of 0.75 or 20; never up to 0.69.
  for (const StencilKind kind : kinds) {
    const Motion fall = moved(kind, above_middle(kind, 1), {0, -2});
    for (const double h : {0.75, 1.0, 20.0}) {
      const auto found = first(kind, fall, h, 0.02);
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, 0.7 - 0.5e-9 * h, 0.51e-9 * h);
    }
    EXPECT_FALSE(first(kind, fall, 0.69, 0.02));
  }
}

TEST(Approach, IncludesATouch) {
  // z = 1/4 + (s - 1/2)^2 touches 1/4, in exact numbers. What widens eta, w = eps (64 + 32 * 4) times at most 6 m, is reached
  // sqrt(w) = 5e-7 before.
  for (const StencilKind kind : kinds) {
    const Motion touch = moved(kind, above_middle(kind, 0.5), {-1, 1});
    const auto found = first(kind, touch, 1, 0.25);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, 0.5, 6e-7);
    EXPECT_FALSE(first(kind, touch, 1, 0.25 - 1e-12));
    EXPECT_FALSE(first(kind, touch, 0.49, 0.25));
  }
}

TEST(Approach, AtTheBeginningIsZero) {
  for (const StencilKind kind : kinds) {
    EXPECT_EQ(first(kind, moved(kind, above_middle(kind, 0.25), {1}), 1, 0.25), 0);
    EXPECT_EQ(first(kind, moved(kind, above_middle(kind, 0.125), {1}), 1, 0.25), 0);
    EXPECT_EQ(first(kind, above_middle(kind, 0), 1, 0), 0);
    // So near that the first piece of the step cannot be proved: later than 0, all the same.
    const auto soon = first(kind, moved(kind, above_middle(kind, 0.25 + 1e-11), {-1}), 1, 0.25);
    ASSERT_TRUE(soon);
    EXPECT_GT(*soon, 0);
    EXPECT_LE(*soon, 1e-9);
  }
}

TEST(Approach, FindsThoseThatPassRightThroughAtAnyDegree) {
  // From 1 above to 1 below, along 1 - 2s and terms c_k (s^k - s) that leave the ends where they are, at speeds below 4. At
  // eta = 0 the way between the sides is rounded by eps S, S = 3: at a height z its direction by eps S / z, and sides of size
  // S apart in it as long as z > eps S^2 / z, z > 4e-8.
  for (const StencilKind kind : kinds)
    for (int degree = 1; degree <= 64; ++degree) {
      Uniform random(3);
      std::vector<double> z(degree, 0.0);
      z[0] = -2;
      for (int k = 2; k <= degree; ++k) {
        z[k - 1] = random(-1, 1) * std::pow(0.5, k);
        z[0] -= z[k - 1];
      }
      const Motion through = moved(kind, above_middle(kind, 1), z);
      z.insert(z.begin(), 1);
      for (const double eta : {0.0, 1e-6}) {
        const auto found = first(kind, through, 1, eta);
        ASSERT_TRUE(found) << "seed 3, degree " << degree;
        EXPECT_NEAR(evaluate(z, *found), eta, eta > 0 ? 4e-9 : 4e-8) << "seed 3, degree " << degree;
      }
    }
}

TEST(Approach, FindsFastVertices) {
  // 1e5 m/s over 1e5 m, through faces and edges of 2 m, half way: the hit is before it by at most 2^-30 of the step, and 0.5 s
  // less eta / v is the truth.
  for (const StencilKind kind : kinds) {
    const auto found = first(kind, moved(kind, above_middle(kind, 5e4), {-1e5}), 1, 0.01);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, 0.5 - 1e-7 - 0.5e-9, 0.51e-9);
  }
  // Past the end of the edge and the corner of the face, 0.02 beside them.
  for (const StencilKind kind : {vertex_edge, vertex_face}) {
    Motion motion = moved(kind, above_middle(kind, 5e4), {-1e5});
    motion[0][0] += motion[1][0] * (kind == vertex_edge ? 1.02 : 1.02);
    EXPECT_FALSE(first(kind, motion, 1, 0.0199));
    EXPECT_TRUE(first(kind, motion, 1, kind == vertex_edge ? 0.0201 : 0.0201 * std::sqrt(2)));
  }
}

TEST(Approach, FarFromTheOriginIsEarlierByItsRounding) {
  // Positions at 1e6 m are known to 64 eps 1e6 = 1.5e-8 m here: at 2 m/s the contact is reported 1e-8 s sooner, no later.
  for (const StencilKind kind : kinds) {
    const Motion near = moved(kind, above_middle(kind, 1), {-2});
    Motion far = near;
    for (Path& path : far) path[0] += Vector(1e6, 1e6, -1e6);
    const double at = first(kind, near, 1, 0.125).value(), far_at = first(kind, far, 1, 0.125).value();
    EXPECT_LE(far_at, at);
    EXPECT_NEAR(far_at, at - 0.5 * 64 * eps * 1e6, 2e-9);
    EXPECT_TRUE(first(kind, far, 0.25, 0.5 - 1e-8));
    EXPECT_FALSE(first(kind, near, 0.25, 0.5 - 1e-8));
    EXPECT_FALSE(first(kind, far, 0.25, 0.5 - 2e-8));
  }
}

TEST(Approach, OfSidesThatMoveTogetherThereIsNone) {
  // However far they go; 1e-6 above eta, where positions up to 1e5 m may be off by 64 (N+2) eps 1e5 < 1e-8 m.
  Uniform random(4);
  for (const StencilKind kind : kinds) {
    Motion motion = above_middle(kind, 0.1 + 1e-6);
    for (int k = 1; k <= 6; ++k) {
      const Vector c(random(-1e4, 1e4), random(-1e4, 1e4), random(-1e4, 1e4));
      for (Path& path : motion) path.push_back(c);
    }
    EXPECT_FALSE(first(kind, motion, 1, 0.1));
    EXPECT_TRUE(first(kind, motion, 1, 0.1 + 1e-6));
  }
}

TEST(Approach, IsDecidedByFewPieces) {
  // A stencil apart from another: one piece, the step. An edge that turns by 1 on a circle about a face or an edge at a
  // distance of 1 + gap: pieces of an angle a leave a^2 / 8 of gap, some 1 / sqrt(8 gap) of them, twice that for halves; with
  // directions that stand still they would be about 1 / gap.
  Approach approach;
  approach.first(vertex_face, views(above_middle(vertex_face, 1)), 1, 0.25);
  EXPECT_EQ(approach.pieces(), 1);
  const double quarter = std::numbers::pi / 2;
  Motion turn = above_middle(edge_edge, 0);
  for (int k = 0; k <= 24; ++k) {
    for (const int i : {2, 3}) turn[i].resize(25, Vector::Zero());
    const double scale = 1 / std::tgamma(k + 1.0);
    const Vector radius = scale * Vector(std::sin(k * quarter), 0, std::cos(k * quarter));
    const Vector tangent = scale * Vector(std::cos(k * quarter), 0, -std::sin(k * quarter));
    turn[2][k] = radius - tangent;
    turn[3][k] = radius + tangent;
  }
  turn[0] = {{0, -1, 0}};
  turn[1] = {{0, 1, 0}};
  for (const double gap : {1e-2, 1e-4, 1e-6}) {
    EXPECT_FALSE(approach.first(edge_edge, views(turn), 1, 1 - gap));
    EXPECT_LE(approach.pieces(), 4 / std::sqrt(8 * gap)) << gap;
  }
  EXPECT_EQ(approach.first(edge_edge, views(turn), 1, 1), 0);
  // A touch: some more pieces for each halving of the distance in time.
  for (const StencilKind kind : kinds) {
    approach.first(kind, views(moved(kind, above_middle(kind, 0.5), {-1, 1})), 1, 0.25);
    EXPECT_LE(approach.pieces(), 200) << static_cast<int>(kind);
  }
}

TEST(Approach, OfParallelEdgesIsThatOfTheirMiddles) {
  for (const double shift : {0.0, 0.5, -1.75}) {
    const Motion motion = {
        {{-1, 0, 1}, {0, 0, -1}}, {{1, 0, 1}, {0, 0, -1}}, {{shift - 1, 0, 0}}, {{shift + 1, 0, 0}}};
    EXPECT_NEAR(first(edge_edge, motion, 1, 0.25).value(), 0.75 - 0.5e-9, 0.51e-9) << shift;
    EXPECT_FALSE(first(edge_edge, motion, 0.749, 0.25)) << shift;
  }
}

TEST(Approach, TakesVerticesOfAnyDegreeUnitAndDimension) {
  Approach approach;
  Uniform random(5);
  for (int k = 0; k < 200; ++k)
    for (const StencilKind kind : kinds) {
      Motion mixed = random_motion(kind, 6, random), raised = mixed, in_halves = mixed;
      for (std::size_t i = 0; i < mixed.size(); ++i) {
        const std::size_t size = i == 0 ? 7 : 2 * i - 1;  // the second one is at rest
        mixed[i].resize(size);
        for (std::size_t j = 0; j < 7; ++j) {
          if (j >= size) raised[i][j].setZero();
          in_halves[i][j] = raised[i][j] * std::pow(0.5, j);
        }
      }
      const auto expected = approach.first(kind, views(raised), 1, 0.1);
      EXPECT_EQ(approach.first(kind, views(mixed), 1, 0.1), expected);
      EXPECT_EQ(approach.first(kind, views(in_halves, 0.5), 1, 0.1), expected);
      EXPECT_EQ(Approach().first(kind, views(mixed), 1, 0.1), expected);
      EXPECT_EQ(approach.comes_within(kind, views(mixed), 1, 0.1), expected.has_value());
    }
}

TEST(Approach, TakesRowsOfAMatrix) {
  // Two particles on a line, and three in the plane, in rows [order][particle][component] with others and padding between,
  // which is not read.
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double line[] = {1, none, 0, none, -2, none, 0, none};
  const PathView on_line[] = {{line, 4, 1, 1, 1}, {line + 2, 4, 1, 1, 1}};
  EXPECT_NEAR(Approach().first(vertex_vertex, on_line, 1, 0.25).value(), 0.375 - 0.5e-9, 0.51e-9);

  const double plane[] = {0.5, 1, none, 0, 0, none, 1, 0, none, 0, -2};
  const PathView in_plane[] = {{plane, 9, 1, 1, 2}, {plane + 3, 9, 0, 1, 2}, {plane + 6, 9, 0, 1, 2}};
  EXPECT_NEAR(Approach().first(vertex_edge, in_plane, 1, 0.25).value(), 0.375 - 0.5e-9, 0.51e-9);
}

TEST(Approach, RefusesWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Motion good = moved(vertex_face, above_middle(vertex_face, 1), {-2, 0});
  const auto message = [](const Motion& motion, double h, double eta) -> std::string {
    try {
      first(vertex_face, motion, h, eta);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const double wrong : {std::nan(""), infinity, -infinity})
    for (int k = 0; k <= 2; ++k) {
      Motion bad = good;
      bad[0][k][1] = wrong;
      EXPECT_EQ(message(bad, 1, 0.1),
                "approach: coefficient " + std::to_string(k) + " of vertex 0 of the stencil is not finite");
    }
  EXPECT_EQ(message(moved(vertex_face, good, {1e300}), 1e10, 0.1),
            "approach: the motion of the stencil overflows within h = 1e+10 s");
  EXPECT_EQ(message(good, 0, 0.1), "approach: h must be > 0 and finite, got 0 s");
  EXPECT_EQ(message(good, infinity, 0.1), "approach: h must be > 0 and finite, got inf s");
  EXPECT_EQ(message(good, 1, -0.1), "approach: eta must be >= 0 and finite, got -0.1 m");
  EXPECT_EQ(message(good, 1, std::nan("")), "approach: eta must be >= 0 and finite, got nan m");
}

}  // namespace
}  // namespace jetlag::testing::approach_test
