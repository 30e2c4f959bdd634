// SPDX-License-Identifier: MIT
// What rounding moves the accelerations by.

#include "jetlag/integrators/force_rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/spring.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::force_rounding_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double n = 64;  // roundings: those of the difference itself, one or two, are little against them

/// What n roundings in a step of length h make of the accelerations, and of their derivatives with order 2.
std::vector<Coordinates<double>> rounding(const Problem& scene, double h, std::size_t orders = 1) {
  std::vector<Coordinates<double>> known(orders);
  Report report;
  EXPECT_TRUE(Accelerations(scene.system)(scene.start, known, report)) << report.message;
  return ForceRounding(scene.system)(scene.start, h, n, known);
}

TEST(ForceRounding, IsStiffnessTimesRoundingOfThePosition) {
  // m x'' = -k (x - offset - 1): k/m n eps |x| u with 1/2 <= |u| < 1, whatever the force itself is.
  for (const double offset : {0.0, 10.0, 1e6})
    for (const double stiffness : {1.0, 1e4}) {
      System<double> system(1, {1.0, 4.0});
      system.fix(0);
      system.add<Spring>({{0, 1}}, {{stiffness, 1.0}});
      Problem scene{std::move(system), {0.0, Coordinates<double>(2, 1), Coordinates<double>::Zero(2, 1)}};
      scene.start.position << offset, offset + 1;  // at rest
      const double da = rounding(scene, 0.1).front()(1, 0),
                   unit = stiffness / 4 * n * eps * scene.start.position(1, 0);
      EXPECT_GT(da, (0.5 - 2 / n) * unit) << offset << " " << stiffness;
      EXPECT_LT(da, (1 + 2 / n) * unit) << offset << " " << stiffness;
      EXPECT_EQ(rounding(scene, 0.1).front()(0, 0), 0.0);  // held
    }
}

TEST(ForceRounding, SeesTwoParticlesThatRoundInTheSameWay) {
  // Both ends of the spring of 1000 dumbbells far away: the two are never moved alike.
  const int pairs = 1000;
  System<double> system(1, std::vector<double>(2 * pairs, 1.0));
  Problem scene{std::move(system),
                {0.0, Coordinates<double>(2 * pairs, 1), Coordinates<double>::Zero(2 * pairs, 1)}};
  for (int i = 0; i < pairs; ++i) {
    scene.system.add<Spring>({{2 * i, 2 * i + 1}}, {{1.0, 1.0}});
    scene.start.position(2 * i, 0) = 1e6;
    scene.start.position(2 * i + 1, 0) = 1e6 + 1;
  }
  // u differs by 0.618 or 0.382 from one to the next, by 0.236 at least where the sign changes too.
  const auto da = rounding(scene, 0.1).front();
  EXPECT_GT(da.minCoeff(), (0.23 - 4 / n) * n * eps * 1e6);
}

TEST(ForceRounding, ContainsThatOfVelocitiesTimeAndTheWayOfTheStep) {
  // Drag c: c n eps (|v| + h |a|) u.  cos(w t) at w t = pi/2: w n eps (t + h) u.
  // A tether at 0 that moves: k n eps h |v| u.
  Problem sliding = oscillator(0.0, 0.0, 2.0), shaken = oscillator(0.0, 0.0, 0.0),
          crossing = oscillator(1.0, 0.0, 3.0);
  sliding.system.add<Drag>({{0}}, {{0.5}});
  shaken.system.add<Shaker>({{0}}, {{std::numbers::pi / 2 * 1e-3}});
  shaken.start.time = 1e3;
  const auto expect_near = [](double da, double unit) {
    EXPECT_GT(da, (0.5 - 2 / n) * unit);
    EXPECT_LT(da, (1 + 2 / n) * unit);
  };
  expect_near(rounding(sliding, 2.0).front()(0, 0), 0.5 * n * eps * (2.0 + 2.0 * 1.0));
  expect_near(rounding(shaken, 10.0).front()(0, 0), std::numbers::pi / 2 * 1e-3 * n * eps * 1010);
  expect_near(rounding(crossing, 0.5).front()(0, 0), n * eps * 1.5);
}

TEST(ForceRounding, ScalesWithTheUnits) {
  // Time in units of 2^-10: accelerations 2^20 times as large, jerks 2^30 times.
  const auto fast = rounding(circular_oscillator(1024.0), 0.1 / 1024, 2),
             slow = rounding(circular_oscillator(1.0), 0.1, 2);
  EXPECT_EQ(fast[0], slow[0] * std::exp2(20));
  EXPECT_EQ(fast[1], slow[1] * std::exp2(30));
  EXPECT_GT(slow[1].maxCoeff(), 0.0);
}

}  // namespace
}  // namespace jetlag::testing::force_rounding_test
