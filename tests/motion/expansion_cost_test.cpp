// SPDX-License-Identifier: MIT
// What coefficients cost, counted in multiplications: N of them cost O(N^2).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/first_order.hpp"
#include "support/counted.hpp"

namespace jetlag::testing {
namespace {

/// Multiplications done by f.
template <class F>
std::int64_t products(F f) {
  const std::int64_t before = Counted::products;
  f();
  return Counted::products - before;
}

TEST(Cost, OfGeometricGrowthIsHalfOfHalfNSquared) {
  // y' = y^2, y(0) = 1 is 1/(1 - t): all ones. Coefficient k of the square costs floor(k/2) + 1 products:
  // N^2/4 + N/2 for even N, within N(N+1)/2.
  for (const int n : {8, 16, 32, 64, 128}) {
    FirstOrderExpansion<Counted> y([](const auto&, const auto& u) { return std::array{u[0] * u[0]}; }, 1);
    y.start(0.0, {1.0});
    EXPECT_EQ(products([&] { y.grow_to(n); }), n * n / 4 + n / 2) << n;
    for (int k = 0; k <= n; ++k) EXPECT_EQ(y[0][k].value, 1.0) << k;
  }
}

TEST(Cost, OfAProductIsHalfNSquared) {  // coefficient k costs k + 1: exactly N(N+1)/2
  for (const int n : {8, 16, 32, 64}) {
    FirstOrderExpansion<Counted> y([](const auto&, const auto& u) { return std::array{u[1], u[0] * u[1]}; },
                                   2);
    y.start(0.0, {1.0, 1.0});
    EXPECT_EQ(products([&] { y.grow_to(n); }), n * (n + 1) / 2) << n;
  }
}

TEST(Cost, OfASpringIsThreeNSquared) {
  // Order k: three squares of k/2, a root of k/2, a quotient of k and three products of k: 6k, and at most 40
  // that do not grow (first terms, stiffness, and three for each of the four padded components of two particles: the
  // mass, and what makes a velocity and a position of it).
  for (const int n : {8, 16, 32, 64}) {
    System<Counted> system(3, {1.0, 1.0});
    system.add<Spring>({{0, 1}}, {{2.0, 1.0}});
    Coordinates<Counted> x(2, 3), v(2, 3);
    for (int c = 0; c < 3; ++c) x(0, c) = 0.0, x(1, c) = 0.8, v(0, c) = 0.1 * c, v(1, c) = -0.1;
    Expansion<Counted> series(system);
    series.start({0.0, x, v});
    EXPECT_LE(products([&] { series.grow_to(n); }), 3 * n * n + 40 * n) << n;
  }
}

TEST(Cost, OfASpringNetworkGrowsWithTheSquareOfTheOrder) {
  // the exponent of the power law through N = 16 and N = 64; 3 would be nested re-evaluation
  const auto cost = [](int n) {
    constexpr int particles = 10;
    System<Counted> ring(3, std::vector<Counted>(particles, 1.0));
    std::vector<std::array<int, 2>> pairs;
    Coordinates<Counted> x(particles, 3), v(particles, 3);
    for (int i = 0; i < particles; ++i) {
      pairs.push_back({i, (i + 1) % particles});
      x(i, 0) = std::cos(0.6 * i), x(i, 1) = std::sin(0.6 * i), x(i, 2) = 0.1 * i;
      v(i, 0) = 0.1 * i, v(i, 1) = -0.05 * i, v(i, 2) = 0.0;
    }
    ring.add<Spring>(pairs, {{3.0, 0.5}});
    Expansion<Counted> series(ring);
    series.start({0.0, x, v});
    return static_cast<double>(products([&] { series.grow_to(n); }));
  };
  const double exponent = std::log(cost(64) / cost(16)) / std::log(64.0 / 16.0);
  EXPECT_LE(exponent, 2.05);
  EXPECT_GE(exponent, 1.7);  // below, the count would not see the convolutions
}

}  // namespace
}  // namespace jetlag::testing
