// SPDX-License-Identifier: MIT
// Coefficients lie one after another and are what was put there.
#include "jetlag/motion/coefficients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace jetlag::testing::coefficients_test {
namespace {

const Coordinates<double> a{{1, 2}, {3, 4}, {5, 6}}, b{{7, 8}, {9, 10}, {11, 12}};

TEST(Coefficients, AreWhatWasPutThere) {
  Coefficients all;
  EXPECT_TRUE(all.empty());
  all.push_back(a);
  all.push_back(2.0 * b);
  ASSERT_EQ(all.size(), 2);
  EXPECT_EQ(all.particles(), 3);
  EXPECT_EQ(all.dimension(), 2);
  EXPECT_EQ(all.front(), a);
  EXPECT_EQ(all.back(), 2.0 * b);
  all[0] += b;
  EXPECT_EQ(all[0], a + b);
  int k = 0;
  for (const auto& coefficient : all) EXPECT_EQ(coefficient, all[k++]);
  EXPECT_EQ(k, 2);
}

TEST(Coefficients, LieOneAfterAnother) {
  const Coefficients all{a, b};
  EXPECT_EQ(all.data(1), all.data(0) + 6);
  for (int n = 0; n < 12; ++n) EXPECT_EQ(all.data(0)[n], n + 1);
  EXPECT_GE(all.bytes(), 12 * sizeof(double));
}

TEST(Coefficients, BeginAsZeros) {
  const Coefficients zeros(3, 2, 1);
  ASSERT_EQ(zeros.size(), 3);
  for (const auto& coefficient : zeros) EXPECT_EQ(coefficient, Coordinates<double>::Zero(2, 1));
}

TEST(Coefficients, MayBeMadeOfThoseThatAreThere) {
  Coefficients all{a};
  for (int k = 1; k < 20; ++k) all.push_back(2.0 * all.back());
  for (int k = 0; k < 20; ++k) EXPECT_EQ(all[k], std::ldexp(1.0, k) * a) << k;
}

TEST(Coefficients, HaveOneShape) {
  Coefficients all{a};
  EXPECT_THROW(all.push_back(Coordinates<double>::Zero(2, 3)), std::invalid_argument);
  EXPECT_EQ(all.size(), 1);
}

}  // namespace
}  // namespace jetlag::testing::coefficients_test
