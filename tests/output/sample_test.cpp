// SPDX-License-Identifier: MIT
#include "jetlag/output/sample.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace jetlag::testing {
namespace {

/// 1, 2 .. n: mean (n + 1)/2, variance n (n + 1)/12, quantile p at 1 + (n - 1) p.
TEST(Sample, KnowsTheWholeNumbers) {
  for (const int n : {2, 3, 21, 100, 1001}) {
    std::vector<double> x;
    for (int i = 0; i < n; ++i) x.push_back(1 + (i * 7919) % n);  // 7919 is a prime: each once
    const Sample sample = sample_of(x);
    EXPECT_NEAR(sample.mean, (n + 1) / 2.0, 1e-13 * n);
    EXPECT_NEAR(sample.spread, std::sqrt(n * (n + 1) / 12.0), 1e-13 * n);
    for (std::size_t q = 0; q < Sample::probabilities.size(); ++q)
      EXPECT_NEAR(sample.quantiles[q], 1 + (n - 1) * Sample::probabilities[q], 1e-13 * n) << n << ' ' << q;
    EXPECT_NEAR(sample.half_width, student_95(n - 1) * sample.spread / std::sqrt(n), 1e-13 * n);
  }
}

TEST(Sample,
     KeepsTheDigitsOfASmallSpread) {  // 1e9 and numbers 1e-6 apart: their squares have no room for that
  const double step = 0x1p-20;
  std::vector<double> x = {0x1p30, 0x1p30 + step, 0x1p30 + 2 * step};
  const Sample sample = sample_of(x);
  EXPECT_DOUBLE_EQ(sample.spread, step);
  EXPECT_EQ(sample.mean, 0x1p30 + step);
}

TEST(Sample, OfOneNumberOrOfEqualOnes) {
  std::vector<double> one = {0.1}, equal(7, 0.1);
  EXPECT_EQ(sample_of(one).mean, 0.1);
  EXPECT_TRUE(std::isnan(sample_of(one).spread));
  EXPECT_TRUE(std::isnan(sample_of(one).half_width));
  EXPECT_EQ(sample_of(one).quantiles[0], 0.1);
  EXPECT_EQ(sample_of(equal).spread, 0.0);
  EXPECT_EQ(sample_of(equal).mean, 0.1);
  std::vector<double> none, infinite = {1.0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(sample_of(none), std::invalid_argument);
  EXPECT_TRUE(std::isnan(sample_of(infinite).mean));
  EXPECT_TRUE(std::isnan(sample_of(infinite).quantiles[2]));
}

TEST(Sample, KnowsStudentsQuantiles) {  // to what the header says
  for (const long freedom : {1, 2, 3, 4, 5, 6, 7, 10, 30, 100, 1000, 1000000}) {
    const boost::math::students_t student(static_cast<double>(freedom));
    const double expected = quantile(student, 0.975);
    const double tolerance = freedom <= 2 ? 1e-6 : freedom < 6 ? 2e-3 : 1e-4;
    EXPECT_NEAR(student_95(freedom), expected, tolerance * expected) << freedom;
  }
  EXPECT_THROW(student_95(0), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing
