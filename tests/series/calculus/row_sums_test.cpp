// SPDX-License-Identifier: MIT
// Sums over the orders of a series for numbers beside each other: what one number gives alone, and closed forms.
#include "jetlag/series/calculus/row_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace row_sums_test {

using jetlag::RowDeparture;
namespace detail = jetlag::detail;

// Counts around the widths at which loops change: a part of eight, eight, several times eight and what is left over.
const std::vector<std::size_t> counts{1, 2, 3, 7, 8, 9, 16, 23, 31, 32, 33, 40, 64, 65, 100};
constexpr std::size_t next_order = 101;

std::vector<double> random_numbers(std::size_t size, unsigned seed) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> between(-2, 2);
  std::vector<double> numbers(size);
  for (double& x : numbers) x = between(draw);
  return numbers;
}

TEST(RowSums, AreThoseOfEachNumberAlone) {
  const auto c = random_numbers(12 * next_order, 1), w = random_numbers(12, 2);
  for (const std::size_t count : counts) {
    std::vector<double> beside(count + 1, 7.0);
    detail::sum_rows(c.data(), next_order, count, 1, 11, w.data(), 0.3, beside.data());
    for (std::size_t i = 0; i < count; ++i) {
      double alone = 0;
      detail::sum_rows<double>(c.data() + i, next_order, 1, 1, 11, w.data(), 0.3, &alone);
      EXPECT_EQ(beside[i], alone) << i << " of " << count;
    }
    EXPECT_EQ(beside[count], 7.0) << "wrote beyond " << count;
  }
}

TEST(RowSums, SumAGeometricSeries) {
  // sum_{n=2..9} 2^-n s^(n-2) at s = 1 is (2^-1 - 2^-9), which binary numbers hold.
  std::vector<double> c(10 * next_order);
  for (int n = 0; n < 10; ++n) std::fill_n(c.begin() + n * next_order, next_order, std::ldexp(1.0, -n));
  const std::vector<double> ones(10, 1.0);
  std::vector<double> sums(37);
  detail::sum_rows(c.data(), next_order, 37, 2, 9, ones.data(), 1.0, sums.data());
  for (const double sum : sums) EXPECT_EQ(sum, 0.5 - 0x1p-9);
}

TEST(RowSums, ThoseOfAMotionAreEachAsIfItWereAlone) {
  // Also where there is no acceleration yet, and none of the velocity.
  const auto x = random_numbers(12 * next_order, 3), v = random_numbers(12 * next_order, 4),
             w = random_numbers(12, 5);
  for (const int last : {0, 1, 2, 3, 11})
    for (const std::size_t count : counts) {
      std::vector<double> together(3 * count + 1, 7.0), alone(3 * count);
      EXPECT_TRUE(
          detail::sum_motion_rows(x.data(), v.data(), next_order, count, last, w.data(), 0.3,
                                  {together.data(), together.data() + count, together.data() + 2 * count}));
      EXPECT_EQ(together.back(), 7.0) << "wrote beyond " << count;
      together.pop_back();
      detail::sum_rows<double>(x.data(), next_order, count, 0, last, w.data(), 0.3, alone.data());
      detail::sum_rows<double>(v.data(), next_order, count, 0, last, w.data(), 0.3, alone.data() + count);
      detail::sum_accelerations<double>(x.data(), next_order, count, last, w.data(), 0.3,
                                        alone.data() + 2 * count);
      EXPECT_EQ(together, alone) << count << " to order " << last;
      std::vector<double> accelerations(count);
      detail::sum_accelerations(x.data(), next_order, count, last, w.data(), 0.3, accelerations.data());
      EXPECT_TRUE(std::equal(accelerations.begin(), accelerations.end(), alone.begin() + 2 * count)) << count;
    }
}

TEST(RowSums, OfAMotionSayWhetherItIsFinite) {
  const std::vector<double> ones(3 * next_order, 1.0);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
    for (const bool of_velocity : {false, true})
      for (const std::size_t count : counts)
        for (std::size_t at = 0; at < count; ++at) {
          std::vector<double> x = ones, v = ones, sums(3 * count);
          (of_velocity ? v : x)[next_order + at] = bad;
          ASSERT_FALSE(detail::sum_motion_rows(x.data(), v.data(), next_order, count, 2, ones.data(), 0.3,
                                               {sums.data(), sums.data() + count, sums.data() + 2 * count}))
              << at << " of " << count;
        }
}

TEST(RowSums, CompareEndsAsEachNumberAlone) {
  const auto x = random_numbers(3 * next_order, 3), ahead = random_numbers(3 * next_order, 4),
             leads_to = random_numbers(next_order, 5);
  for (const std::size_t count : counts) {
    RowDeparture<double> beside, alone;
    detail::compare_ends(leads_to.data(), x.data(), ahead.data(), next_order, count, beside);
    detail::compare_ends<double>(leads_to.data(), x.data(), ahead.data(), next_order, count, alone);
    EXPECT_EQ(beside.force, alone.force);
    EXPECT_EQ(beside.position, alone.position);
    for (const int side : {0, 1}) {
      EXPECT_EQ(beside.velocity[side], alone.velocity[side]);
      EXPECT_EQ(beside.acceleration[side], alone.acceleration[side]);
    }
  }
}

TEST(RowSums, AForceThatIsNotANumberDepartsWithoutBound) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::size_t count : counts)
      for (std::size_t at = 0; at < count; ++at) {
        std::vector<double> x(3 * next_order, 1.0), ahead(3 * next_order, 1.0), leads_to(count, 2.0);
        ahead[2 * next_order + at] = bad;
        RowDeparture<double> departure;
        detail::compare_ends(leads_to.data(), x.data(), ahead.data(), next_order, count, departure);
        ASSERT_EQ(departure.force, std::numeric_limits<double>::infinity()) << at << " of " << count;
      }
}

TEST(RowSums, TheFirstTermOutweighsTheRestWhereItDoesInEachNumber) {
  // 1 against 1/4 h + 1000 (h^2 + h^3) / 4: below up to h = .0609, the root of that sum less 1.
  std::vector<double> c(4 * next_order, 0.25);
  std::fill_n(c.begin(), next_order, -1.0);
  for (const std::size_t count : counts) {
    EXPECT_TRUE(detail::outweighs_rest(c.data(), next_order, count, 3, 0.0608)) << count;
    EXPECT_FALSE(detail::outweighs_rest(c.data(), next_order, count, 3, 0.0610)) << count;
    for (std::size_t at = 0; at < count; ++at) {
      std::vector<double> one = c;
      for (const double weak : {0.0, 1e-3, -1e-3, std::numeric_limits<double>::quiet_NaN()}) {
        one[at] = weak;
        ASSERT_FALSE(detail::outweighs_rest(one.data(), next_order, count, 3, 0.05))
            << weak << " at " << at << " of " << count;
      }
      one[at] = -1;
      one[3 * next_order + at] = -std::numeric_limits<double>::infinity();
      ASSERT_FALSE(detail::outweighs_rest(one.data(), next_order, count, 3, 0.05)) << at << " of " << count;
    }
  }
}

TEST(RowSums, WhatIsConstantOutweighsNothingElse) {
  const double positive = 1e-300, none = 0;
  EXPECT_TRUE(detail::outweighs_rest(&positive, 0, 1, 0, 1.0));
  EXPECT_FALSE(detail::outweighs_rest(&none, 0, 1, 0, 1.0));
}

}  // namespace row_sums_test
