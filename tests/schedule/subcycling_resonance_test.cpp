// SPDX-License-Identifier: MIT
// Steps that resonate: where subcycling is unstable.
#include <gtest/gtest.h>


#include "schedule/subcycling_for_tests.hpp"

namespace jetlag::testing {
namespace {

/// Of the chain wall-100-A-1-B-1-wall: p / q steps h of A are one of B, in `p` of A they meet.
double radius(double h, int p, int q = 1) {
  return cycle_radius(wall_chain(), coarse_b(h, static_cast<double>(p) / q), h, p);
}

/// The step between `stable` and `unstable` where the radius leaves 1. It does so as the root of the distance: a radius of
/// 1 + 1e-6 tells the edge to some 1e-9.
double edge(double stable, double unstable, int p, int q = 1) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (radius(middle, p, q) > 1 + 1e-6 ? unstable : stable) = middle;
  }
  return unstable;
}

// Reference: 75-digit arithmetic.
TEST(SubcyclingResonance, HasTheBandOfTheChainWithRatioFour) {
  EXPECT_NEAR(edge(0.1260, 0.12725, 4), 0.1268403737, 1e-9);
  EXPECT_NEAR(edge(0.1285, 0.12725, 4), 0.1276082943, 1e-9);
  EXPECT_NEAR(radius(0.12725, 4), 1.0112361938, 1e-9);
}
TEST(SubcyclingResonance, HasTheBandOfTheChainWithRatioFive) {
  EXPECT_NEAR(edge(0.1035, 0.1045, 5), 0.1041663835, 1e-9);
  EXPECT_NEAR(edge(0.1055, 0.1045, 5), 0.1048236827, 1e-9);
  EXPECT_NEAR(radius(0.1045, 5), 1.0110089606, 1e-9);
}
TEST(SubcyclingResonance, IsTheLimitOfLeapfrogWithRatioOne) {
  EXPECT_NEAR(edge(0.198, 0.2, 1), 0.1989974874, 2e-9);
}
TEST(SubcyclingResonance, HasBandsForRealRatios) {
  // Edges and radii of 5/2 from a loop over plain matrices.
  EXPECT_NEAR(edge(0.1785, 0.17975, 5, 2), 0.1794743683, 1e-8);
  EXPECT_NEAR(edge(0.1810, 0.17975, 5, 2), 0.1800768707, 1e-8);
  EXPECT_NEAR(radius(0.1795, 5, 2), 1.0075812, 1e-6);
  EXPECT_NEAR(radius(0.17975, 5, 2), 1.018873, 1e-6);
  EXPECT_NEAR(radius(0.16, 3, 2), 1.0023, 5e-5);
  EXPECT_NEAR(radius(0.14225, 7, 3), 1.0013, 5e-5);
  EXPECT_NEAR(radius(0.1865, 7, 3), 1.0239, 5e-5);
}
TEST(SubcyclingResonance, IsNoneOutsideTheBands) {
  // A radius of 1 is known to the root of rounding where two eigenvalues are close.
  for (const double h : {0.02, 0.05, 0.1, 0.12, 0.1265, 0.128, 0.14}) EXPECT_NEAR(radius(h, 4), 1, 1e-7) << h;
  for (const double h : {0.02, 0.06, 0.0985, 0.1035, 0.1055}) EXPECT_NEAR(radius(h, 5), 1, 1e-7) << h;
  for (const double h : {0.1, 0.15, 0.178, 0.182}) EXPECT_NEAR(radius(h, 5, 2), 1, 1e-7) << h;
}

}  // namespace
}  // namespace jetlag::testing
