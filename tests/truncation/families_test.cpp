// SPDX-License-Identifier: MIT
// Every law with every draw: unbiased over a million seeds, for one update as for the next; and what is special in how
// the draws of one seed go together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "jetlag/truncation/draws.hpp"
#include "truncation/laws.hpp"

namespace jetlag::testing::families_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Draw all_draws[] = {Draw::independent,     Draw::rotation,   Draw::ruler,
                              Draw::scrambled_ruler, Draw::stratified, Draw::antithetic};
constexpr std::uint32_t particles = 7;

std::string name(Draw kind) { return names_of_draws[static_cast<int>(kind)]; }

/// Laws for this kind of draw; a ruler needs a tail that falls by whole numbers.
std::vector<LawAndTerms> laws_for(Draw kind) {
  if (kind != Draw::ruler && kind != Draw::scrambled_ruler) return laws();
  const auto e = exponential_terms(16);
  return {{geometric(3, 6, 0.5), e},
          {geometric(3, 16, 0.8), e},
          {TruncationLaw("mixed bases", {1, 1, 1.0 / 3, 1.0 / 3, 1.0 / 15, 1.0 / 30}), e},
          {single_term(geometric(2, 8, 2.0 / 3)), e}};
}

/// z of the mean of g over a million seeds: the number drawn is that of a particle's update 17.
double z_over_seeds(Draw kind, const TruncationLaw& drawn, const TruncationLaw& weighted,
                    const std::vector<double>& terms) {
  const int n = 1'000'000;
  const auto g = outcomes(weighted, terms);
  double truth = 0, total = 0;
  for (int k = 0; k <= drawn.max_degree(); ++k) truth += terms[k];
  for (int seed = 1; seed <= n; ++seed)
    total += g[Draws(kind, &drawn, seed, particles).degree(drawn, 3, 17)] - truth;
  return total / std::sqrt(n * variance(drawn, terms));
}

class EveryDraw : public ::testing::TestWithParam<Draw> {};

TEST_P(EveryDraw, IsUnbiasedWithEveryLaw) {
  for (const auto& [law, terms] : laws_for(GetParam())) {
    if (law.is_fixed()) continue;
    EXPECT_LT(std::abs(z_over_seeds(GetParam(), law, law, terms)), 4) << law.name() << ", seeds 1 .. 1e6";
  }
}

TEST_P(EveryDraw, FailsTheSameTestWithTheWeightsOfAnotherLaw) {  // 3 % off the first probability below 1
  const auto [law, terms] = laws_for(GetParam())[GetParam() == Draw::ruler ? 0 : 1];
  std::vector<double> tail;
  for (int n = 0; n <= law.max_degree(); ++n)
    tail.push_back(law.at_least(n) * (n > law.min_degree() ? 1.03 : 1));
  EXPECT_GT(std::abs(z_over_seeds(GetParam(), law, {"biased", tail}, terms)), 4) << "seeds 1 .. 1e6";
}

INSTANTIATE_TEST_SUITE_P(Draws, EveryDraw, ::testing::ValuesIn(all_draws),
                         [](const auto& info) { return name(info.param); });

// ---- over time --------------------------------------------------------------------------------------------

/// By how much the numbers of updates out of `n` that reach each term miss n P(K >= k), at most.
double largest_debt(Draw kind, const TruncationLaw& law, std::uint64_t first, int n) {
  const Draws draws(kind, &law, 5, particles);
  std::vector<int> reached(law.max_degree() + 1);
  for (int i = 0; i < n; ++i)
    for (int k = draws.degree(law, shared_by_all, first + i); k > law.min_degree(); --k) ++reached[k];
  double most = 0;
  for (int k = law.min_degree() + 1; k <= law.max_degree(); ++k)
    most = std::max(most, std::abs(reached[k] - n * law.at_least(k)));
  return most;
}

TEST(Ruler,
     OwesNoTermMoreThanOneUpdate) {  // of any n in a row, floor or ceil of n / b^i are multiples of b^i
  for (double base : {2.0, 3.0, 5.0, 11.0})
    for (std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1'000'000'000'000}})
      for (int n : {1, 100, 12345, 1 << 17})
        EXPECT_LT(largest_debt(Draw::ruler, geometric(3, 9, 1 - 1 / base), first, n), 1.0)
            << base << ", " << n;
}

TEST(ScrambledRuler, OwesNoTermMoreThanTwoUpdates) {  // one for the broken block at either end
  for (double base : {2.0, 3.0, 5.0})
    for (int n : {1, 100, 12345, 1 << 17})
      EXPECT_LT(largest_debt(Draw::scrambled_ruler, geometric(3, 9, 1 - 1 / base), 77, n), 2.0)
          << base << ", " << n;
}

TEST(Rotation, OwesNoTermMoreThanTheLogarithmOfTheUpdates) {
  // n is a sum of at most log_phi(n) + 2 Fibonacci numbers; of a Fibonacci number of points in a row, which are evenly
  // spread but for less than a spacing each, any interval holds its share to 2.
  const TruncationLaw law = geometric(3, 9, 0.37);
  for (std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1'000'000'000'000}})
    for (int n : {100, 12345, 1 << 17})
      EXPECT_LT(largest_debt(Draw::rotation, law, first, n),
                2 * (std::log(n) / std::log(std::numbers::phi) + 2));
  // Independent draws owe sqrt(n P (1 - P)), 175 here, or some: the test can fail.
  EXPECT_GT(largest_debt(Draw::independent, law, 0, 1 << 17), 53) << "seed 5";
}

TEST(
    Rotation,
    OwesLittleAtThresholdsOfTheGoldenRatio) {  // 1-p = phi^2: bounded for ever [Kesten 1966], here for the first term
  const TruncationLaw law("golden", {1, std::pow(std::numbers::phi, -2)});
  for (int n = 1; n < 100'000; n += 997) EXPECT_LE(largest_debt(Draw::rotation, law, 0, n), 1.0 + 1e-9) << n;
}

TEST(Antithetic, MirrorsItsNumbersInPairs) {
  for (std::uint64_t n : {0ull, 10ull, 1ull << 40})
    EXPECT_NEAR(antithetic(1, 2, n) + antithetic(1, 2, n + 1), 1.0, 0x1p-53) << n;  // each rounded by 2^-54
  EXPECT_NE(antithetic(1, 2, 0), antithetic(1, 2, 2));
}

TEST(Stratified, PutsOneParticleInEachStratum) {
  for (std::uint32_t n : {2u, 3u, 7u, 64u, 1000u})
    for (std::uint64_t update : {0ull, 1ull, 1ull << 40}) {
      std::vector<int> count(n);
      for (std::uint32_t i = 0; i < n; ++i)
        ++count.at(static_cast<int>(std::ceil(stratified(4, i, update, n) * n)) - 1);
      EXPECT_THAT(count, ::testing::Each(1)) << n << ", " << update;
    }
  // In another order at each update: particle 0 is seen in many of 1000 strata.
  std::vector<int> seen(1000);
  for (int update = 0; update < 1000; ++update)
    ++seen[static_cast<int>(std::ceil(stratified(4, 0, update, 1000) * 1000)) - 1];
  EXPECT_GT(std::ranges::count_if(seen, [](int c) { return c > 0; }), 580) << "seed 4";  // 632 +- 10 expected
}

// ---- keys -------------------------------------------------------------------------------------------------

TEST_P(EveryDraw,
       DiffersFromSeedToSeedAndParticleToParticle) {  // rulers of 20000 updates have as many offsets
  const TruncationLaw law = geometric(2, 40, 0.5);
  const auto degrees = [&](std::uint64_t seed, std::uint32_t particle) {
    const Draws draws(GetParam(), &law, seed, particles);
    std::vector<int> k;
    for (int n = 0; n < 20'000; ++n) k.push_back(draws.degree(law, particle, n));
    return k;
  };
  EXPECT_EQ(degrees(1, 2), degrees(1, 2));
  EXPECT_NE(degrees(1, 2), degrees(2, 2));
  EXPECT_NE(degrees(1, 2), degrees(1, 3));
  EXPECT_NE(degrees(1, 2), degrees(1ull << 32 | 1, 2));
}

// ---- what does not go together ----------------------------------------------------------------------------

auto refused(const char* a, const char* b) {
  return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(a), HasSubstr(b)));
}

TEST(Ruler, RefusesProbabilitiesThatAreNotOneInAWholeNumber) {
  EXPECT_THAT([] { Ruler(geometric(3, 6, 0.6)); }, refused("term 4 is 0.4", "one in 2.5"));
  EXPECT_THAT([] { Ruler(geometric(3, 6, 0.3)); }, refused("term 4 is 0.7", "must be one in 2, 3, 4"));
  EXPECT_NO_THROW(Ruler(geometric(3, 16, 0.9)));
  EXPECT_THAT([] { Draws(Draw::ruler, nullptr, 1, 1); }, refused("ruler", "sequential"));
  EXPECT_THAT([] { Draws(Draw::stratified, nullptr, 1, 1); }, refused("stratified", "over particles"));
}

TEST(Ruler, CountsUpdatesBeyondAnyNumber) {  // 11^60 is beyond 2^64
  const TruncationLaw law = geometric(1, 60, 10.0 / 11);
  const Draws draws(Draw::ruler, &law, 3, 1);
  for (std::uint64_t n : {std::uint64_t{0}, ~std::uint64_t{0} - 5}) {
    int reached = 0;
    for (std::uint64_t i = 0; i < 11 && n + i >= n; ++i) reached += draws.degree(law, 0, n + i) > 1;
    EXPECT_LE(reached, 1);
  }
}

}  // namespace
}  // namespace jetlag::testing::families_test
