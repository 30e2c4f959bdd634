// SPDX-License-Identifier: MIT
// Polynomials in the Bernstein basis, beside each other, and the halves of their interval.

#include "jetlag/series/calculus/bernstein.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "jetlag/series/calculus/polynomial.hpp"
#include "support/close.hpp"
#include "support/random.hpp"

namespace jetlag::testing::bernstein_test {
namespace {

using ::testing::ElementsAre;

/// sum_i b_i C(N,i) u^i (1-u)^(N-i) of one of the polynomials.
double value(const std::vector<double>& rows, std::size_t width, std::size_t j, double u) {
  const std::size_t n = rows.size() / width - 1;
  double sum = 0, binomial = 1;
  for (std::size_t i = 0; i <= n; ++i) {
    sum += rows[i * width + j] * binomial * std::pow(u, i) * std::pow(1 - u, n - i);
    binomial = binomial * double(n - i) / double(i + 1);
  }
  return sum;
}

TEST(Bernstein, OfSquaresBesideOnesAndLines) {
  // u^2 has the control points i (i-1) / (N (N-1)), u has i / N, 1 has ones.
  std::vector<double> rows{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};  // N = 4
  detail::to_bernstein<3>(rows.data(), 4);
  const std::vector<double> expected{1, 0, 0, 1, 0.25, 0, 1, 0.5, 1.0 / 6, 1, 0.75, 0.5, 1, 1, 1};
  EXPECT_THAT(rows, IsCloseTo(expected, ulps(2)));
}

TEST(Bernstein, HasTheValuesOfThePolynomialAndOfItsParts) {
  // 20 terms of size 1: each rounded a few times by N eps/2, from either form.
  const std::size_t n = 20;
  Uniform random(1);
  std::vector<double> c[2], rows;
  for (std::size_t k = 0; k <= n; ++k)
    for (auto& one : c) rows.push_back(one.emplace_back(random(-1, 1)));
  detail::to_bernstein<2>(rows.data(), n);
  for (const double u : {0.5, 0.375}) {
    std::vector<double> after = rows, before(rows.size());
    detail::split_bernstein<2>(after.data(), before.data(), n, u);
    for (std::size_t j = 0; j < 2; ++j)
      for (const double s : {0.0, 0.3, 1.0}) {
        EXPECT_NEAR(value(rows, 2, j, s), evaluate(c[j], s), 1e-13);
        EXPECT_NEAR(value(before, 2, j, s), evaluate(c[j], u * s), 1e-13);
        EXPECT_NEAR(value(after, 2, j, s), evaluate(c[j], u + (1 - u) * s), 1e-13);
      }
  }
}

TEST(Bernstein, SplitsALineInTheMiddle) {
  std::vector<double> after{0, 1}, before(2);
  detail::split_bernstein<1>(after.data(), before.data(), 1, 0.5);
  EXPECT_THAT(before, ElementsAre(0, 0.5));
  EXPECT_THAT(after, ElementsAre(0.5, 1));
}

}  // namespace
}  // namespace jetlag::testing::bernstein_test
