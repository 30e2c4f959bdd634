// SPDX-License-Identifier: MIT
// What is not a candidate is farther apart than the reach, as long as the list is said to hold.
#include "jetlag/contact/candidates.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>
#include <vector>

#include "support/random.hpp"

namespace jetlag::testing::candidates_test {
namespace {

constexpr double reach = 0.05;

/// Particles on random polynomials of this degree, in units of 1 s.
struct Moving {
  int dimension, particles, degree = 3;
  std::vector<double> c = {};
  double time = 0;

  Moving(int dimension, int particles, double spread, double speed, unsigned seed)
      : dimension(dimension), particles(particles) {
    Uniform draw(seed);
    c.resize(static_cast<std::size_t>(degree + 1) * particles * dimension);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const std::size_t order = i / (static_cast<std::size_t>(particles) * dimension);
      c[i] = order == 0 ? draw(0, spread) : draw(-1, 1) * speed * std::pow(0.3, order - 1);
    }
  }

  PositionSeries series() const {
    return {time,
            1.0,
            c.data(),
            degree,
            static_cast<std::size_t>(particles) * dimension,
            static_cast<std::size_t>(dimension)};
  }
  SeriesAhead ahead(double h) const { return {series(), dimension, h}; }
  Eigen::Vector3d at(int particle, double s) const {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int n = degree; n >= 0; --n)
      for (int d = 0; d < dimension; ++d) x[d] = x[d] * s + series().coefficient(n, particle)[d];
    return x;
  }
  /// Goes on to a later time.
  void advance(double h) {
    for (int i = 0; i < particles; ++i)
      for (int d = 0; d < dimension; ++d) {
        const auto place = [&](int n) -> double& {
          return c[static_cast<std::size_t>(n) * particles * dimension + i * dimension + d];
        };
        for (int first = 0; first < degree; ++first)
          for (int n = degree - 1; n >= first; --n) place(n) += h * place(n + 1);
      }
    time += h;
  }
};

/// All stencils of a surface.
std::vector<Stencil> all_stencils(const Surface& surface, int dimension) {
  std::vector<Stencil> all;
  if (dimension == 2)
    for (const int p : surface.vertices())
      for (const auto& [a, b] : surface.edges())
        if (p != a && p != b) all.push_back({StencilKind::vertex_edge, {p, a, b, -1}});
  if (dimension == 3) {
    for (const int p : surface.vertices())
      for (const auto& [a, b, c] : surface.triangles())
        if (p != a && p != b && p != c) all.push_back({StencilKind::vertex_face, {p, a, b, c}});
    for (const auto& e : surface.edges())
      for (const auto& f : surface.edges())
        if (e < f && e[0] != f[0] && e[0] != f[1] && e[1] != f[0] && e[1] != f[1])
          all.push_back({StencilKind::edge_edge, {e[0], e[1], f[0], f[1]}});
  }
  for (std::size_t i = 0; i < surface.loose_vertices().size(); ++i)
    for (std::size_t j = i + 1; j < surface.loose_vertices().size(); ++j)
      all.push_back(
          {StencilKind::vertex_vertex, {surface.loose_vertices()[i], surface.loose_vertices()[j], -1, -1}});
  std::ranges::sort(all);
  return all;
}

/// A surface of 30 particles: single points on a line, edges in the plane, triangles in space.
Surface surface_in(int dimension) {
  std::vector<int> points;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 30; ++i) {
    if (dimension == 1) points.push_back(i);
    if (dimension == 2 && i % 2 == 0) edges.push_back({i, i + 1});
    if (dimension == 3 && i % 3 == 0) triangles.push_back({i, i + 1, i + 2});
  }
  return {triangles, edges, points};
}

class CandidatesIn : public ::testing::TestWithParam<int> {};

TEST_P(CandidatesIn, AreAllThatComeWithinReach) {
  const int dimension = GetParam();
  const Surface surface = surface_in(dimension);
  const std::vector<Stencil> all = all_stencils(surface, dimension);
  int close = 0;
  for (const double speed : {0.0, 0.1, 10.0})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      Moving moving(dimension, 30, dimension == 1 ? 10 : 2, speed, seed);
      Candidates candidates(surface, System<double>(dimension, std::vector<double>(30, 1.0)), reach);
      Uniform draw(seed);
      for (int step = 0; step < 20; ++step) {
        double h = draw(0.001, 0.05);
        h = candidates.cover(moving.ahead(h), h);
        ASSERT_GT(h, 0);
        for (const double part : {0.0, 0.3, 0.7, 1.0})
          for (const Stencil& stencil : all) {
            std::vector<Eigen::Vector3d> x;
            for (const int i : stencil.particles()) x.push_back(moving.at(i, part * h));
            if (!(closest(stencil.kind, x).distance <= reach)) continue;
            ++close;
            ASSERT_TRUE(std::ranges::binary_search(candidates.list(), stencil));
          }
        moving.advance(h);
      }
    }
  EXPECT_GT(close, 100);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CandidatesIn, ::testing::Values(1, 2, 3));

TEST(Candidates, AreLookedForAnewWhenAVertexHasLeftItsRoomNotBefore) {
  const Surface surface = surface_in(3);
  Moving moving(3, 30, 2, 1.0, 3);
  for (int i = 0; i < 30; ++i)  // straight lines, which tracks are
    for (int n = 2; n <= 3; ++n)
      for (int d = 0; d < 3; ++d) moving.c[static_cast<std::size_t>(n) * 90 + i * 3 + d] = 0;
  Candidates candidates(surface, System<double>(3, std::vector<double>(30, 1.0)), reach);
  for (int step = 0; step < 8; ++step) {
    EXPECT_EQ(candidates.cover(moving.ahead(1e-3), 1e-3), 1e-3);
    moving.advance(1e-3);
  }
  EXPECT_EQ(candidates.looks(), 1u);
  moving.c[1 * 90 + 5] += 1000;  // one turns aside
  candidates.cover(moving.ahead(1e-3), 1e-3);
  EXPECT_EQ(candidates.looks(), 2u);
}

TEST(Candidates, LeaveOutFixedParticlesAloneAndWhereAskedABodyWithItself) {
  System<double> system(3, std::vector<double>(8, 1.0));
  for (const int i : {0, 1, 2, 3}) system.fix(i);
  const Surface surface({{0, 1, 2}, {1, 2, 3}, {4, 5, 6}, {5, 6, 7}}, {}, {});
  Moving moving(3, 8, 0.01, 0.0, 1);  // all within reach of all
  const auto count = [&](bool with_itself) {
    Candidates candidates(surface, system, reach, with_itself);
    candidates.cover(moving.ahead(1.0), 1.0);
    return candidates.list().size();
  };
  // Between the bodies 2 x 4 x 2 vertices and faces, 5 x 5 edges; in the one that moves 2 and 2.
  EXPECT_EQ(count(false), 16u + 25u);
  EXPECT_EQ(count(true), 16u + 25u + 2u + 2u);
}

}  // namespace
}  // namespace jetlag::testing::candidates_test
