// SPDX-License-Identifier: MIT
// The random sum g = sum_{n<=K} c_n / P(K >= n): its moments, against exact enumeration, and its samples.

#include "jetlag/truncation/truncation.hpp"

#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/truncation/draws.hpp"

namespace jetlag::testing::truncation_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// P(K >= n) = (1-p)^(n-m) with any m >= 0, by the constructor.
TruncationLaw geometric_from(int m, int n, double p) {
  std::vector<double> tail(n + 1, 1.0);
  for (int k = m + 1; k <= n; ++k) tail[k] = tail[k - 1] * (1.0 - p);
  return {"geometric", tail};
}

/// 1/n!, n = 0 .. N.
std::vector<double> exponential_terms(int n) {
  std::vector<double> c(n + 1, 1.0);
  for (int k = 1; k <= n; ++k) c[k] = c[k - 1] / k;
  return c;
}

/// n c_n.
std::vector<double> slopes(std::vector<double> c) {
  for (std::size_t n = 0; n < c.size(); ++n) c[n] *= static_cast<double>(n);
  return c;
}

/// Moments of g = sum w_n/n! and f = sum w_n n/n! over all outcomes of K, in exact fractions: P(K = k), not
/// the tail sums under test.
struct Moments {
  Rational mean, variance, covariance, mean_degree;
};
Moments enumerated(int m, int n, const Rational& p) {
  Rational g = 0, f = 0, survival = 1, factorial = 1, weight = 1;
  Rational mean_g = 0, mean_f = 0, mean_gg = 0, mean_gf = 0, mean_k = 0;
  for (int k = 0; k <= n; ++k) {
    if (k > 0) factorial *= k;
    if (k > m) weight /= 1 - p;
    g += weight / factorial;
    f += weight * k / factorial;
    if (k < m) continue;
    const Rational probability = k == n ? survival : Rational(survival * p);
    survival *= 1 - p;
    mean_g += probability * g;
    mean_f += probability * f;
    mean_gg += probability * g * g;
    mean_gf += probability * g * f;
    mean_k += probability * k;
  }
  return {mean_g, mean_gg - mean_g * mean_g, mean_gf - mean_g * mean_f, mean_k};
}

struct Case {
  int min_degree, max_degree;
  double p;
  double mean, variance, covariance, mean_degree;  // published values; NaN where there is none
};
constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<Case> published = {
    {3, 6, 0.5, 2.7180555555555555556, 0.0028375771604938271605, 0.012152777777777777778, 3.875},
    {4, 16, 0.5, none, 1.0440121039933974883e-4, 5.4714373901232742307e-4, 4.999755859375},
    {0, 16, 0.5, none, 4.1979212575243848623, none, none},
    {3, 6, 0.25, none, 9.234253543667123914e-4, none, none},
};

TEST(RandomSum, HasThePublishedMoments) {
  for (const Case& c : published) {
    SCOPED_TRACE(::testing::Message() << "(" << c.min_degree << ", " << c.max_degree << ", " << c.p << ")");
    const TruncationLaw law = geometric_from(c.min_degree, c.max_degree, c.p);
    const auto g = exponential_terms(c.max_degree), f = slopes(g);
    // A sum of N positive terms of some 2 N rounded factors each (the differences of weights are exact here).
    const double tolerance = 3 * c.max_degree * eps;
    EXPECT_NEAR(variance(law, g), c.variance, tolerance * c.variance);
    if (!std::isnan(c.covariance)) {
      EXPECT_NEAR(covariance(law, g, f), c.covariance, tolerance * c.covariance);
    }
    if (!std::isnan(c.mean_degree)) {
      EXPECT_NEAR(law.mean(), c.mean_degree, tolerance * c.mean_degree);
    }
    if (!std::isnan(c.mean)) {
      double mean = 0, sum = 0;
      for (int k = 0; k <= c.max_degree; ++k) {
        sum += law.weight(k) * g[k];
        mean += (law.at_least(k) - law.at_least(k + 1)) * sum;
      }
      EXPECT_NEAR(mean, c.mean, tolerance * c.mean);
    }
  }
}

TEST(RandomSum, HasTheMomentsOfItsEnumeration) {
  for (int n : {1, 2, 5, 6, 16})
    for (int m = 0; m <= n; ++m)
      for (double p : {0.125, 0.5, 0.75}) {  // 1 - p is exact, and so are all tails
        SCOPED_TRACE(::testing::Message() << "(" << m << ", " << n << ", " << p << ")");
        const Moments exact = enumerated(m, n, Rational(p));
        const TruncationLaw law = geometric_from(m, n, p);
        const auto g = exponential_terms(n), f = slopes(g);
        const auto near = [&](double value, const Rational& truth) {
          const double t = truth.convert_to<double>();
          EXPECT_NEAR(value, t, 3 * n * eps * t);  // as above
        };
        near(variance(law, g), exact.variance);
        near(covariance(law, g, f), exact.covariance);
        near(covariance(law, f, g), exact.covariance);
        near(law.mean(), exact.mean_degree);
      }
}

TEST(RandomSum, HasNoVarianceWhereTheDegreeIsFixed) {
  EXPECT_EQ(variance(fixed_degree(6), exponential_terms(6)), 0.0);
  EXPECT_EQ(variance(geometric(6, 6, 0.5), exponential_terms(6)), 0.0);
  EXPECT_EQ(variance(geometric(3, 6, 0.0), exponential_terms(6)), 0.0);
}

/// Mean and variance of n samples of g: K drawn from one law, terms weighted by another.
struct Sample {
  double mean, variance;
};
Sample sample(const TruncationLaw& drawn, const TruncationLaw& weighted, std::uint64_t seed, int n) {
  const auto c = exponential_terms(weighted.max_degree());
  std::vector<double> g(c.size());
  double sum = 0;
  for (std::size_t k = 0; k < c.size(); ++k) g[k] = sum += weighted.weight(static_cast<int>(k)) * c[k];
  double mean = 0, squares = 0;  // Welford's update
  for (int i = 0; i < n; ++i) {
    const double x = g[drawn.draw(uniform(seed, 0, i))], difference = x - mean;
    mean += difference / (i + 1);
    squares += difference * (x - mean);
  }
  return {mean, squares / (n - 1)};
}

TEST(RandomSum, IsUnbiasedAndScattersAsPredicted) {
  const std::uint64_t seed = 1;
  const int n = 1'000'000;
  SCOPED_TRACE("seed 1");
  for (const TruncationLaw& law : {geometric(3, 6, 0.5), geometric(3, 6, 0.25), geometric(4, 7, 0.5)}) {
    const auto c = exponential_terms(law.max_degree());
    double truth = 0;
    for (double term : c) truth += term;
    const double v = variance(law, c);
    const Sample s = sample(law, law, seed, n);
    EXPECT_LT(std::abs(s.mean - truth), 4 * std::sqrt(v / n));  // z-test
    // The sample variance scatters by sqrt((kurtosis - 1) / n), below 0.3 % here (kurtosis < 10).
    EXPECT_NEAR(s.variance, v, 0.02 * v);
  }
}

TEST(RandomSum, FailsTheSameTestWhenDrawsAndWeightsDisagree) {
  const TruncationLaw law = geometric(3, 6, 0.5), other = geometric(3, 6, 0.45);
  const auto c = exponential_terms(6);
  double truth = 0;
  for (double term : c) truth += term;
  const int n = 1'000'000;
  const Sample s = sample(other, law, 1, n);
  EXPECT_GT(std::abs(s.mean - truth), 4 * std::sqrt(variance(law, c) / n)) << "seed 1";
}

TEST(TruncationLaw, DrawsTheLargestDegreeThatUReaches) {
  const TruncationLaw law("steps", {1.0, 1.0, 0.5, 0.5, 0.125});
  EXPECT_EQ(law.min_degree(), 1);
  EXPECT_EQ(law.max_degree(), 4);
  EXPECT_EQ(law.draw(1.0), 1);
  EXPECT_EQ(law.draw(std::nextafter(0.5, 1.0)), 1);
  EXPECT_EQ(law.draw(0.5), 3);  // degree 2 has no probability of its own
  EXPECT_EQ(law.draw(std::nextafter(0.125, 1.0)), 3);
  EXPECT_EQ(law.draw(0.125), 4);
  EXPECT_EQ(law.draw(0x1p-53), 4);
  EXPECT_EQ(law.at_least(5), 0.0);
}

TEST(TruncationLaw, RefusesWhatIsNoTail) {
  const auto tail = [](std::vector<double> values) { return [values] { TruncationLaw("tail", values); }; };
  const auto refused = [](const char* what) { return ThrowsMessage<std::invalid_argument>(HasSubstr(what)); };
  EXPECT_THAT(tail({}), refused("largest degree must be at least 1"));
  EXPECT_THAT(tail({1.0}), refused("largest degree must be at least 1"));
  EXPECT_THAT(tail({0.5, 0.5}), refused("tail: P(K >= 0) must be 1"));
  EXPECT_THAT(tail({none, 0.5}), refused("P(K >= 0) must be 1"));
  EXPECT_THAT(tail({1.0, 0.25, 0.5}), refused("P(K >= 2) must not be larger"));
  EXPECT_THAT(tail({1.0, 1.5}), refused("P(K >= 1) must not be larger"));
  EXPECT_THAT(tail({1.0, none}), refused("P(K >= 1)"));
  EXPECT_THAT(tail({1.0, 0.5, 0.0}), refused("P(K >= 2) is so small"));
  EXPECT_THAT(tail({1.0, -0.5}), refused("P(K >= 1) is so small"));
  EXPECT_THAT(tail({1.0, 1e-310}), refused("P(K >= 1) is so small"));  // its inverse overflows
}

TEST(Geometric, RefusesParametersOutOfRangeByName) {
  const auto law = [](int m, int n, double p) { return [=] { geometric(m, n, p); }; };
  const auto refused = [](const char* name, const char* value) {
    return ThrowsMessage<std::invalid_argument>(
        AllOf(HasSubstr("geometric"), HasSubstr(name), HasSubstr(value)));
  };
  EXPECT_THAT(law(0, 6, 0.5), refused("min_degree", "got 0"));
  EXPECT_THAT(law(-2, 6, 0.5), refused("min_degree", "got -2"));
  EXPECT_THAT(law(4, 3, 0.5), refused("max_degree", "got 3"));
  EXPECT_THAT(law(3, 6, -0.25), refused("probability", "got -0.25"));
  EXPECT_THAT(law(3, 6, 1.25), refused("probability", "got 1.25"));
  EXPECT_THAT(law(3, 6, none), refused("probability", "nan"));
  EXPECT_THAT(law(3, 6, 1.0), refused("probability 1", "never draw"));
  EXPECT_THAT(law(1, 2000, 0.5), refused("P(K >= ", "overflows"));
  EXPECT_THAT([] { fixed_degree(0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("degree must be at least 1")));
}

TEST(Geometric, AllowsProbabilityOneWhereNothingIsDrawn) {
  EXPECT_EQ(geometric(3, 3, 1.0).draw(0.5), 3);
  EXPECT_TRUE(geometric(3, 3, 1.0).is_fixed());
}

TEST(Geometric, NeverStopsEarlyAtProbabilityZero) {
  EXPECT_TRUE(geometric(3, 6, 0.0).is_fixed());
  EXPECT_EQ(geometric(3, 6, 0.0).draw(1.0), 6);
}

TEST(Covariance, RefusesSeriesThatAreTooShort) {
  const TruncationLaw law = geometric(3, 6, 0.5);
  EXPECT_THAT([&] { variance(law, std::vector<double>(6)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("7 terms")));
}

}  // namespace
}  // namespace jetlag::testing::truncation_test
