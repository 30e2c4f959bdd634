// SPDX-License-Identifier: MIT
// Counter-based random numbers: a function of their key, uniform, and without memory.

#include "jetlag/truncation/draws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "jetlag/truncation/truncation.hpp"

namespace jetlag::testing {
namespace {

constexpr double significance = 1e-6;

/// The largest chi^2 that is believed.
double chi_squared_limit(int degrees_of_freedom) {
  const boost::math::chi_squared distribution(degrees_of_freedom);
  return boost::math::quantile(boost::math::complement(distribution, significance));
}

TEST(Uniform, IsPhilox) {
  // Known answer of Philox4x32-10 for counter 0 and key 0 [Random123, kat_vectors]: 6627e8d5 e169c58d ...
  EXPECT_EQ(uniform(0, 0, 0), (static_cast<double>(0x6627e8d5e169c58dull) + 1) * 0x1p-64);
}

TEST(Uniform, LiesAboveZeroAndUpToOne) {
  double least = 1, largest = 0;
  for (std::uint64_t n = 0; n < 1'000'000; ++n) {
    const double u = uniform(1, 2, n);
    least = std::min(least, u);
    largest = std::max(largest, u);
    ASSERT_GT(u, 0.0);
    ASSERT_LE(u, 1.0);
    ASSERT_EQ(std::fmod(u * 0x1p64, 1.0), 0.0);  // a multiple of 2^-64
  }
  // The chance that a million numbers leave a gap of 14e-6 at an end is e^-14 < 1e-6.
  EXPECT_LT(least, 14e-6);
  EXPECT_GT(largest, 1 - 14e-6);
}

constexpr int cells = 1000;

/// chi^2 of a million numbers of (0, 1] in 1000 cells.
template <class F>
double chi_squared_of_evenness(F number) {
  const int n = 1'000'000;
  std::vector<int> count(cells);
  for (int i = 0; i < n; ++i) ++count[static_cast<int>(std::ceil(number(i) * cells)) - 1];
  double chi = 0;
  for (int c : count) chi += std::pow(c - n / cells, 2) / (n / cells);
  return chi;
}

TEST(Uniform, FillsTheIntervalEvenly) {
  EXPECT_LT(chi_squared_of_evenness([](int i) { return uniform(3, 4, i); }), chi_squared_limit(cells - 1))
      << "seed 3";
}

TEST(StandardNormal, IsEvenlySpreadByItsDistributionFunction) {
  const boost::math::normal normal;
  const auto probability = [&](int i) { return boost::math::cdf(normal, standard_normal(3, 4, i)); };
  EXPECT_LT(chi_squared_of_evenness(probability), chi_squared_limit(cells - 1)) << "seed 3";
}

TEST(StandardNormal, HasNothingToDoWithTheUniformNumberOfItsKeyNorWithItsNeighbours) {
  const int n = 200'000;
  double with_uniform = 0, with_next_update = 0, with_next_particle = 0;
  for (int i = 0; i < n; ++i) {
    const double x = standard_normal(5, 6, i);
    with_uniform += (x * x - 1) / std::sqrt(2.0) * (uniform(5, 6, i) - 0.5) * std::sqrt(12.0);
    with_next_update += x * standard_normal(5, 6, i + 1);
    with_next_particle += x * standard_normal(5, 7, i);
  }
  // Sums of n products of mean 0 and variance 1: 5 sigma is a chance of 6e-7.
  for (double sum : {with_uniform, with_next_update, with_next_particle})
    EXPECT_LT(std::abs(sum), 5 * std::sqrt(n)) << "seed 5";
}

TEST(Uniform, DependsOnItsKeyAlone) {
  const std::vector<std::uint64_t> seeds = {0, 1, 1ull << 32, ~0ull},
                                   updates = {0, 1, 7, 1ull << 32, 1ull << 63};
  const std::vector<std::uint32_t> particles = {0, 1, 1u << 31, shared_by_all};
  std::vector<double> forwards, backwards;
  for (auto s : seeds)
    for (auto p : particles)
      for (auto u : updates) forwards.push_back(uniform(s, p, u));
  for (auto s = seeds.rbegin(); s != seeds.rend(); ++s)
    for (auto p = particles.rbegin(); p != particles.rend(); ++p)
      for (auto u = updates.rbegin(); u != updates.rend(); ++u) backwards.push_back(uniform(*s, *p, *u));
  EXPECT_EQ(forwards, std::vector<double>(backwards.rbegin(), backwards.rend()));

  // Every part of the key counts, its high halves too: all numbers differ (but for a chance of 80^2 / 2^54).
  std::ranges::sort(forwards);
  EXPECT_EQ(std::ranges::adjacent_find(forwards), forwards.end());
}

TEST(Uniform, HasUncorrelatedNeighbours) {
  const int n = 200'000;
  const auto correlation = [&](auto a, auto b) {  // both of mean 1/2 and variance 1/12
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += (a(i) - 0.5) * (b(i) - 0.5);
    return 12 * sum / n;
  };
  const auto at = [](std::uint64_t seed, std::uint32_t particle, std::uint64_t step) {
    return [=](int i) { return uniform(5 + seed, 6 + particle, i + step); };
  };
  const auto of_particle = [](int i) { return uniform(5, i, 9); };
  const auto of_next_particle = [](int i) { return uniform(5, i + 1, 9); };
  // Products of independent numbers: mean 0, variance 1/n after scaling; 5 sigma is a chance of 6e-7.
  const double limit = 5 / std::sqrt(n);
  EXPECT_LT(std::abs(correlation(at(0, 0, 0), at(0, 0, 1))), limit) << "next update, seed 5";
  EXPECT_LT(std::abs(correlation(at(0, 0, 0), at(0, 1, 0))), limit) << "next particle, seed 5";
  EXPECT_LT(std::abs(correlation(at(0, 0, 0), at(1, 0, 0))), limit) << "next seed, seed 5";
  EXPECT_LT(std::abs(correlation(of_particle, of_next_particle)), limit) << "along particles, seed 5";
  EXPECT_NEAR(correlation(at(0, 0, 0), at(0, 0, 0)), 1.0,
              0.02);  // the measure itself: 4 sigma of (u - 1/2)^2
}

TEST(Draw, FollowsItsLaw) {
  const int n = 1'000'000;
  for (const TruncationLaw& law :
       {geometric(3, 6, 0.5), geometric(4, 16, 0.5), geometric(1, 8, 0.1), geometric(2, 6, 0.9),
        TruncationLaw("mixed", {1, 0.9, 0.9, 0.3, 0.2, 0.001})}) {
    SCOPED_TRACE(law.name());
    std::vector<int> count(law.max_degree() + 1);
    for (int i = 0; i < n; ++i) ++count[law.draw(uniform(7, shared_by_all, i))];
    double chi = 0;
    int cells = 0;
    for (int k = 0; k <= law.max_degree(); ++k) {
      const double expected = n * (law.at_least(k) - law.at_least(k + 1));
      if (expected == 0.0) {
        EXPECT_EQ(count[k], 0);
        continue;
      }
      ASSERT_GT(expected, 5.0);  // or the distribution of chi^2 is not the one assumed
      chi += std::pow(count[k] - expected, 2) / expected;
      ++cells;
    }
    EXPECT_LT(chi, chi_squared_limit(cells - 1)) << "seed 7";
  }
}

}  // namespace
}  // namespace jetlag::testing
