// SPDX-License-Identifier: MIT
// Some particles expanded against the known series of the others: the same coefficients as when all are expanded.

#include "jetlag/motion/partial_expansion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/motion/expansion.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::partial_expansion_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// F = c (v_other - v_own): a force between two particles that reads velocities.
struct Damper {
  static constexpr const char* name = "damper";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& c) {
    return T(c) * Vector<T, D>(p.velocity[1] - p.velocity[0]);
  }
};

/// Particles in a box, each with springs and dampers to the next few; every seventh is fixed. All laws of the library
/// and one that depends on time act.
Problem network(int particles, std::uint64_t seed) {
  Uniform random(seed);
  std::vector<double> mass(particles);
  for (double& m : mass) m = random(0.5, 2.0);
  System<double> system(3, mass);
  Problem scene{std::move(system),
                {0.5, Coordinates<double>(particles, 3), Coordinates<double>(particles, 3)}};
  std::vector<std::array<int, 1>> each;
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < particles; ++i) {
    for (int c = 0; c < 3; ++c) {
      scene.start.position(i, c) = random(-1, 1) + i;
      scene.start.velocity(i, c) = i % 7 == 3 ? 0.0 : random(-1, 1);
    }
    if (i % 7 == 3) scene.system.fix(i);
    each.push_back({i});
    for (int j = i + 1; j < std::min(particles, i + 4); ++j) {
      pairs.push_back({i, j});
      springs.push_back({random(1, 5), random(0.5, 1)});
    }
  }
  scene.system.add<Spring>(pairs, springs);
  scene.system.add<Damper>(pairs, {{0.3}});
  scene.system.add<Drag>(each, {{0.1}});
  scene.system.add<UniformField>(each, {{0.0, 0.1, -1.0}});
  scene.system.add<Shaker>(each, {{2.0}});
  return scene;
}

/// A group of a network beside the whole of it.
struct Pair {
  Problem scene;
  Model<> graph;
  Expansion<double> whole;
  std::vector<int> places;

  Pair(int particles, int order)
      : scene(network(particles, 7)), graph(scene.system), whole(graph), places(particles, -1) {
    whole.start(scene.start);
    whole.grow_to(order);
  }

  /// Rows of the present time, orders 0 and 1 of the active and all of the known.
  void fill(PartialExpansion& group, int order) const {
    for (int k = 0; k <= order; ++k) {
      for (std::size_t a = 0; a < group.active().size() && k < 2; ++a)
        for (int c = 0; c < 3; ++c) group.active_row(k, a)[c] = whole.position(k)(group.active()[a], c);
      for (std::size_t b = 0; b < group.known().size(); ++b)
        for (int c = 0; c < 3; ++c) group.known_row(k, b)[c] = whole.position(k)(group.known()[b], c);
    }
  }

  /// The largest difference to the whole, relative to the largest coefficient of each order.
  double difference(const PartialExpansion& group, int order) const {
    double worst = 0;
    for (int k = 0; k <= order; ++k)
      for (std::size_t a = 0; a < group.active().size(); ++a)
        for (int c = 0; c < 3; ++c)
          worst =
              std::max(worst, std::abs(group.active_row(k, a)[c] - whole.position(k)(group.active()[a], c)) /
                                  whole.position_norm(k));
    return worst;
  }
};

std::vector<int> every(int step, int first, int last) {
  std::vector<int> chosen;
  for (int i = first; i < last; i += step)
    if (i % 7 != 3) chosen.push_back(i);
  return chosen;
}

TEST(PartialExpansion, AgreesWithTheWholeOnEveryGroup) {
  // 60 elements wide and more, so that several blocks run. Sums come in another order: some eps a coefficient, growing
  // with the order as errors of a series do.
  const int particles = 150;
  for (int order : {2, 3, 9, 16}) {
    const Pair pair(particles, order);
    std::vector<int> places = pair.places;
    PartialExpansion group(pair.graph, order);
    for (const auto& chosen : {every(1, 0, particles), every(2, 0, particles), every(1, 20, 60),
                               every(5, 1, 30), std::vector{50}, every(1, 0, 140)}) {
      group.choose(chosen, places);
      EXPECT_EQ(std::ranges::count(places, -1), particles);
      pair.fill(group, order);
      group.grow_to(order, pair.scene.start.time);
      EXPECT_LT(pair.difference(group, order), 64 * eps * order)
          << chosen.size() << " particles, order " << order;
    }
  }
}

TEST(PartialExpansion, CostsTheElementsThatTouchTheGroup) {
  // Particle 50 has three springs and three dampers on either side, a drag, a shaker, and a constant field, which has
  // one order only. 50 - 1 = 49, 50 + 1 = 51 are free, so that all of them count.
  Pair pair(150, 8);
  PartialExpansion group(pair.graph, 8);
  group.choose(std::vector{50}, pair.places);
  pair.fill(group, 8);
  group.grow_to(8, pair.scene.start.time);
  EXPECT_EQ(group.element_coefficients(), (6u + 6u + 1u + 1u) * 7u + 1u);
  EXPECT_EQ(group.known().size(), 6u);
}

TEST(PartialExpansion, ForgetsTheGroupBefore) {
  Pair pair(150, 12);
  PartialExpansion used(pair.graph, 12), fresh(pair.graph, 12);
  for (const auto& chosen : {every(1, 0, 150), every(3, 0, 90), every(1, 40, 44)}) {
    used.choose(chosen, pair.places);
    pair.fill(used, 12);
    used.grow_to(12, pair.scene.start.time);
  }
  fresh.choose(every(1, 40, 44), pair.places);
  pair.fill(fresh, 12);
  fresh.grow_to(12, pair.scene.start.time);
  for (int k = 0; k <= 12; ++k)
    for (std::size_t a = 0; a < fresh.active().size(); ++a)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(used.active_row(k, a)[c], fresh.active_row(k, a)[c]);
}

TEST(PartialExpansion, IsChosenOnceAndFilledAgain) {
  // With other groups chosen in between in other places, and with other series before: what is left of them is nothing.
  Pair pair(40, 8), before(40, 8);
  before.scene.start.position.array() *= 1.5;
  before.whole.start(before.scene.start);
  before.whole.grow_to(8);
  const auto grow = [](PartialExpansion& group, Pair& from) {
    from.fill(group, 8);
    group.grow_to(8, from.scene.start.time);
  };
  for (const auto& chosen : {every(1, 11, 12), every(1, 11, 13)}) {  // 6 and 11 springs: 8 and 16 lanes
    PartialExpansion kept(pair.graph, 8), other(pair.graph, 8), fresh(pair.graph, 8);
    kept.choose(chosen, pair.places);
    grow(kept, before);
    for (const auto& between : {every(1, 0, 40), every(1, 11, 12), every(1, 11, 13)}) {  // 32, 8 and 16 lanes
      other.choose(between, pair.places);
      grow(other, before);
    }
    fresh.choose(chosen, pair.places);
    grow(kept, pair);
    grow(fresh, pair);
    for (int k = 0; k <= 8; ++k)
      for (std::size_t a = 0; a < chosen.size(); ++a)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(kept.active_row(k, a)[c], fresh.active_row(k, a)[c]);
  }
}

TEST(PartialExpansion, ShiftsWhatIsKnownToThePresent) {
  // (1 + t)^n about s is sum_k C(n, k) (1 + s)^(n-k) t^k. All terms are positive for s > 0: n + k roundings each.
  constexpr int order = 10;
  Pair pair(150, order);
  PartialExpansion group(pair.graph, order);
  group.choose(every(2, 0, 100), pair.places);
  const auto binomial = [](int n, int k) {
    return std::round(std::tgamma(n + 1) / (std::tgamma(k + 1) * std::tgamma(n - k + 1)));
  };
  std::vector<double> s;
  for (std::size_t b = 0; b < group.known().size(); ++b) {
    s.push_back(0.01 * static_cast<double>(b));
    for (int k = 0; k <= order; ++k)
      for (int c = 0; c < 3; ++c) group.known_row(k, b)[c] = (c + 1) * binomial(order, k);
  }
  group.shift_known(order, s);
  for (std::size_t b = 0; b < s.size(); ++b)
    for (int k = 0; k <= order; ++k)
      for (int c = 0; c < 3; ++c) {
        const double expected = (c + 1) * binomial(order, k) * std::pow(1 + s[b], order - k);
        EXPECT_NEAR(group.known_row(k, b)[c], expected, 3 * order * eps * expected) << b << " " << k;
      }
}

TEST(Model, KnowWhoSharesAnElement) {
  const Pair pair(150, 2);
  const auto of = [&](int i) {
    const auto n = pair.graph.neighbours(i);
    return std::vector<int>(n.begin(), n.end());
  };
  EXPECT_EQ(of(50), (std::vector{47, 48, 49, 51, 53}));  // 52 is fixed
  EXPECT_EQ(of(0), (std::vector{1, 2}));                 // and so is 3
  EXPECT_TRUE(of(3).empty());
}

}  // namespace
}  // namespace jetlag::testing::partial_expansion_test
