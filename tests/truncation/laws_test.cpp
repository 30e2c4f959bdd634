// SPDX-License-Identifier: MIT
// Each truncation law: unbiased and with the variance of its closed form, by enumeration of its degrees; its own
// theorem.

#include "truncation/laws.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <boost/math/distributions/poisson.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "jetlag/truncation/draws.hpp"

namespace jetlag::testing::laws_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

auto refused(const char* what) { return ThrowsMessage<std::invalid_argument>(HasSubstr(what)); }

/// E f(K), by enumeration.
template <class F>
double mean_of(const TruncationLaw& law, F f) {
  double mean = 0;
  for (int k = 0; k <= law.max_degree(); ++k) mean += law.exactly(k) * f(k);
  return mean;
}

TEST(EveryLaw, IsUnbiasedForTheSumUpToItsLargestDegree) {
  for (const auto& [law, terms] : laws()) {
    const auto g = outcomes(law, terms);
    double truth = 0, size = 0;
    for (int n = 0; n <= law.max_degree(); ++n) truth += terms[n];
    for (int k = 0; k <= law.max_degree(); ++k) size += law.exactly(k) * std::abs(g[k]);
    // P(K = k) is a difference of numbers up to 1, off by eps, where weights are up to w: relative N w eps / (N w)
    // terms.
    EXPECT_NEAR(mean_of(law, [&](int k) { return g[k]; }), truth, 40 * eps * std::max(size, 1.0))
        << law.name();
  }
}

TEST(EveryLaw, HasTheVarianceOfItsEnumeration) {
  for (const auto& [law, terms] : laws()) {
    const auto g = outcomes(law, terms);
    std::vector<double> slopes;
    for (std::size_t n = 0; n < terms.size(); ++n) slopes.push_back(static_cast<double>(n) * terms[n]);
    const auto f = outcomes(law, slopes);
    const double mean = mean_of(law, [&](int k) { return g[k]; }),
                 slope = mean_of(law, [&](int k) { return f[k]; });
    const auto cov = mean_of(law, [&](int k) { return (g[k] - mean) * (f[k] - slope); });
    const auto var = mean_of(law, [&](int k) { return (g[k] - mean) * (g[k] - mean); });
    // As above, squares of numbers up to 10; the probabilities of large ones are differences, known to eps.
    EXPECT_NEAR(variance(law, terms), var, 1e-12 * var + 1e-13) << law.name();
    EXPECT_NEAR(covariance(law, terms, slopes), cov, 1e-12 * std::abs(cov) + 1e-13) << law.name();
  }
}

TEST(EveryLaw, CostsItsMeanWhereOrdersCountAndHalfItsSquareWhereProductsDo) {
  for (const auto& [law, terms] : laws()) {
    const int n = law.max_degree();
    EXPECT_NEAR(expected_cost(law, linear_cost(n)), mean_of(law, [](int k) { return k; }), 1e-13)
        << law.name();
    EXPECT_NEAR(expected_cost(law, quadratic_cost(n)), mean_of(law, [](int k) { return k * (k + 1) / 2; }),
                1e-12)
        << law.name();
  }
  EXPECT_THAT([] { expected_cost(fixed_degree(3), linear_cost(2)); }, refused("4 increments"));
}

TEST(EveryLaw, AddsToAQuadraticFormWhatItsEnumerationAdds) {  // Q(x) = x_0^2 + x_0 x_1 + 3 x_1^2
  const auto form = [](const Eigen::Vector2d& x) { return x[0] * x[0] + x[0] * x[1] + 3 * x[1] * x[1]; };
  for (const auto& [law, terms] : laws()) {
    const auto term = [&, &terms = terms](int n) { return Eigen::Vector2d(terms[n], (n - 3.5) * terms[n]); };
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (int n = 0; n <= law.max_degree(); ++n) mean += term(n);
    const double truth = mean_of(law, [&, &law = law](int k) {
      Eigen::Vector2d g = Eigen::Vector2d::Zero();
      for (int n = 0; n <= k; ++n) g += law.weight(n, k) * term(n);
      return form(g) - form(mean);
    });
    const double added = random_part(law, Eigen::Vector2d(0, 0), term, form);
    EXPECT_NEAR(added, truth, 1e-12 * added + 1e-12) << law.name();
  }
}

// ---- Poisson ----------------------------------------------------------------------------------------------

TEST(Poisson, HasTheTailOfItsDistribution) {
  for (double mean : {1e-3, 0.5, 3.0, 40.0}) {
    const TruncationLaw law = poisson(2, 22, mean);
    const boost::math::poisson_distribution<> distribution(mean);
    for (int i = 1; i <= 20; ++i) {
      const double truth = boost::math::cdf(boost::math::complement(distribution, i - 1.0));
      // exp and lgamma of numbers up to 150: as many eps.
      EXPECT_NEAR(law.at_least(2 + i), truth, 200 * eps * truth) << mean << ", " << i;
    }
  }
  EXPECT_NEAR(poisson(3, 40, 1.5).mean(), 4.5, 1e-13);
}

TEST(Poisson, RefusesParametersOutOfRange) {
  EXPECT_THAT([] { poisson(0, 5, 1.0); }, refused("min_degree must be at least 1, got 0"));
  EXPECT_THAT([] { poisson(3, 2, 1.0); }, refused("max_degree must be at least min_degree = 3, got 2"));
  EXPECT_THAT([] { poisson(3, 5, 0.0); }, refused("mean must be > 0"));
  EXPECT_THAT([] { poisson(3, 250, 0.1); }, refused("overflows"));
}

// ---- least cost for a variance ----------------------------------------------------------------------------

TEST(VarianceCapped, HasThePublishedTailsForTheExponential) {
  const auto e = exponential_terms(16);
  const double cap =
      1.0440121039933974883e-4;  // that of geometric (4, 16, 1/2), whose mean degree is 4.999755859375
  const TruncationLaw law = variance_capped(e, cap);
  EXPECT_NEAR(variance(law, e), cap,
              1e-9 * cap);  // bisection, to 1e-13 of a logarithm, times the slope of the variance
  EXPECT_NEAR(law.mean(), 4.6698, 5e-5);  // published digits
  EXPECT_EQ(law.at_least(4), 1.0);
  EXPECT_NEAR(law.at_least(5), 0.5634, 5e-5);
  EXPECT_NEAR(law.at_least(6), 0.09178, 5e-6);
  EXPECT_NEAR(law.at_least(7), 0.01289, 5e-6);
  EXPECT_EQ(law.min_degree(), 4);
}

TEST(VarianceCapped, CannotBeMadeCheaperAtTheSameVariance) {
  // Any two probabilities traded against each other at the same variance, to either side, cost more: a convex problem
  // has no other minimum. Terms that do not fall evenly make it pool, and costs count.
  const std::vector<double> terms = {1, 0.5, -0.3, 0.0, 0.2, 0.05, -0.08, 0.01, 0.002};
  for (const auto& cost : {linear_cost(8), quadratic_cost(8)}) {
    const double cap = 0.05;
    const TruncationLaw best = variance_capped(terms, cap, cost);
    std::vector<double> tail;
    for (int n = 0; n <= 8; ++n) tail.push_back(best.at_least(n));
    for (int n = 1; n <= 8; ++n)
      for (double factor : {0.98, 1.02}) {
        auto other = tail;
        for (int k = 1; k <= 8; ++k)
          if (k >= n) other[k] = std::min({1.0, other[k] * factor, other[k - 1]});
        // All of them scaled until the variance is the same again: by bisection.
        double low = 0.5, high = 2;
        const auto scaled = [&](double s) {
          auto t = other;
          for (int k = 1; k <= 8; ++k) t[k] = std::min(1.0, s * t[k]);
          return TruncationLaw("scaled", t);
        };
        for (int i = 0; i < 60; ++i) {
          const double s = (low + high) / 2;
          (variance(scaled(s), terms) > cap ? low : high) = s;
        }
        EXPECT_GE(expected_cost(scaled(high), cost), expected_cost(best, cost) * (1 - 1e-9))
            << n << ", " << factor;
      }
  }
}

TEST(VarianceCapped, IsGeometricForGeometricTermsAndUnitCost) {  // best 1 - p = r, where the sum does not end
  std::vector<double> terms(41);
  for (int n = 0; n <= 40; ++n) terms[n] = std::pow(0.25, n);
  const TruncationLaw law = variance_capped(terms, 1e-4);
  for (int n = law.min_degree() + 2; n < 20; ++n)
    EXPECT_NEAR(law.at_least(n) / law.at_least(n - 1), 0.25, 1e-10)
        << n;  // the end, 4^-21, is felt by its square root
}

TEST(VarianceCapped, RefusesWhatHasNoBest) {
  const auto e = exponential_terms(4);
  EXPECT_THAT([&] { variance_capped(e, 0.0); }, refused("max_variance must be > 0"));
  EXPECT_THAT([&] { variance_capped(std::vector<double>{1, 0, 0}, 1.0); }, refused("a term other than 0"));
  EXPECT_THAT([&] { variance_capped(std::vector<double>{1, NAN}, 1.0); }, refused("term 1 is not finite"));
  EXPECT_THAT([&] { variance_capped(std::vector<double>{1, 1, -1}, 1.0); }, refused("cancel"));
  EXPECT_THAT([&] { variance_capped(e, 1.0, linear_cost(3)); }, refused("5 terms, got 4"));
  EXPECT_THAT([&] { variance_capped(e, 1.0, std::vector<double>{0, 1, 0, 1, 1}); }, refused("increment 2"));
}

// ---- sequential -------------------------------------------------------------------------------------------

TEST(Sequential, SumsTheExponentialAsBhanotAndKennedyDo) {
  // g = K + 1, mean e^x, E g^2 = sum (2n + 1) x^n / n!. The series ends at 15, of which .5^16 / 16! is left; at 16 the
  // probability of going on would be below what is drawn.
  const double x = 0.5;
  const auto terms = exponential_terms(15, x);
  const TruncationLaw law = bhanot_kennedy(x, 15).given(terms);
  for (int k = 0; k <= 15; ++k) EXPECT_NEAR(stopped(law, terms, k), k + 1, 1e-12);
  EXPECT_NEAR(mean_of(law, [&](int k) { return k + 1; }), std::exp(x), 1e-14);
  EXPECT_NEAR(std::exp(x), 1.648721, 5e-7);
  EXPECT_NEAR(variance(law, terms), 0.5791607, 5e-8);
  EXPECT_NEAR(variance(law, terms), 2 * x * std::exp(x) + std::exp(x) - std::exp(2 * x), 1e-14);
}

TEST(Sequential, IsAskedWithWhatIsKnownAndNoMore) {
  const auto terms = exponential_terms(6);
  const SequentialLaw law("spy", 2, 6, 0.1, [&](int n, std::span<const double> sizes, double weight) {
    EXPECT_EQ(sizes.size(), n);
    EXPECT_EQ(sizes[n - 1], terms[n - 1]);
    EXPECT_NEAR(weight, std::pow(2.0, n - 3), 1e-15);
    return 0.5;
  });
  EXPECT_EQ(law.given(terms).at_least(6), 0.0625);
}

TEST(Sequential, KeepsWeightedTermsOfAGeometricSeriesAtOneSize) {
  // c_n = r^n: of the last four terms a = c_{n-2}, b = c_{n-4}, sqrt(a / b) = r, e_n = c_{n-1}: what is kept at the
  // target is w_n c_n / r. Up to where that falls below the target, all terms are taken.
  const double r = 0.25, target = 1e-3;
  std::vector<double> terms(21);
  for (int n = 0; n <= 20; ++n) terms[n] = std::pow(r, n);
  const TruncationLaw law = sequential(4, 20, target).given(terms);
  EXPECT_EQ(law.min_degree(), 5);  // c_4 = 3.9e-3 > 1e-3 > c_5 = 9.8e-4
  for (int n = 6; n <= 20; ++n) EXPECT_NEAR(law.weight(n) * terms[n] / r, target, 1e-12 * target) << n;
}

TEST(Sequential, RefusesParametersOutOfRange) {
  EXPECT_THAT([] { sequential(0, 5, 1.0); }, refused("min_degree must be at least 1, got 0"));
  EXPECT_THAT([] { sequential(3, 2, 1.0); },
              refused("max_degree must be at least 1 and min_degree = 3, got 2"));
  EXPECT_THAT([] { sequential(3, 5, 0.0); }, refused("target must be > 0"));
  EXPECT_THAT([] { sequential(3, 5, 1.0, 0.0); }, refused("least must be in (0, 1]"));
  EXPECT_GE(sequential(3, 250, 1.0, 0.05).lower_bound().at_least(250), least_probability);
  EXPECT_THAT([] { sequential(3, 5, 1.0).given(std::vector<double>(4)); }, refused("5 terms are needed"));
}

// ---- single term ------------------------------------------------------------------------------------------

TEST(SingleTerm, TakesOneTermOfTheRest) {
  const auto terms = exponential_terms(8);
  const TruncationLaw law = single_term(geometric(3, 8, 0.5));
  double first = 0;
  for (int n = 0; n <= 3; ++n) first += terms[n];
  EXPECT_EQ(stopped(law, terms, 3), first);
  for (int k = 4; k <= 8; ++k)
    EXPECT_NEAR(stopped(law, terms, k), first + terms[k] * std::pow(2.0, k == 8 ? 5 : k - 2), 1e-14) << k;
}

TEST(SingleTerm, ScattersMoreThanTheCoupledSum) {
  const auto e = exponential_terms(8);
  EXPECT_GT(variance(single_term(geometric(3, 8, 0.5)), e), variance(geometric(3, 8, 0.5), e));
}

TEST(SingleTerm, RefusesDegreesThatAreNeverDrawn) {
  const TruncationLaw gap("gap", {1, 1, 0.5, 0.5, 0.25});
  EXPECT_THAT([&] { single_term(gap); }, refused("P(K = 2) must be > 0"));
}

// ---- where the variance ends ------------------------------------------------------------------------------

TEST(LargestRatio, IsWhereTheTermsOfTheVarianceStopFalling) {
  // c_n = r^n: the variance of geometric truncation converges as N grows for r < sqrt(1-p), and grows as
  // (r^2 / (1-p))^N beyond.
  const double p = 0.5;
  EXPECT_NEAR(geometric(2, 60, p).largest_ratio(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(fixed_degree(5).largest_ratio(), 1.0);
  const auto ratio = [&](double r) {
    const auto var = [&](int n) {
      std::vector<double> terms(n + 1);
      for (int k = 0; k <= n; ++k) terms[k] = std::pow(r, k);
      return variance(geometric(2, n, p), terms);
    };
    return var(80) / var(60);
  };
  EXPECT_NEAR(ratio(0.95 * std::sqrt(0.5)), 1.0, 0.2);  // 0.95^120 of it is left after 60
  EXPECT_NEAR(std::log(ratio(1.1 * std::sqrt(0.5))), 40 * std::log(1.1), 0.1 * 40 * std::log(1.1));
}

}  // namespace
}  // namespace jetlag::testing::laws_test
