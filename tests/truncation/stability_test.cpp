// SPDX-License-Identifier: MIT
// Stability of randomly stopped series: y' = lambda y.

#include "jetlag/truncation/stability.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <boost/math/tools/roots.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace jetlag::testing::stability_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Complex = std::complex<double>;

const Complex i(0, 1);

double real_limit(const TruncationLaw& law, Growth of) { return stability_limit(law, of, -1.0); }
double imaginary_limit(const TruncationLaw& law, Growth of) { return stability_limit(law, of, i); }

/// P(K >= n) = (1-p)^(n-m) with any m >= 0.
TruncationLaw geometric_from(int m, int n, double p) {
  std::vector<double> tail(n + 1, 1.0);
  for (int k = m + 1; k <= n; ++k) tail[k] = tail[k - 1] * (1.0 - p);
  return {"geometric", tail};
}

// ---- limits -----------------------------------------------------------------------------------------------

TEST(StabilityLimit, HasThePublishedValuesForFixedDegrees) {
  struct Limits {
    int degree;
    double real, imaginary;
  };
  for (const Limits& l : {Limits{1, 2, 0},
                          {2, 2, 0},
                          {3, 2.512745, 1.7320508},
                          {4, 2.785294, 2.8284271},
                          {5, 3.217048, 0},
                          {6, 3.553441, 0},
                          {7, 3.954130, 1.7644213},
                          {8, 4.313627, 3.3951402},
                          {11, 5.450423, 1.7011883},
                          {12, 5.822779, 3.3793773},
                          {15, 6.950283, 1.6687366},
                          {16, 7.324334, 3.3248131}}) {
    SCOPED_TRACE(l.degree);
    const TruncationLaw law = fixed_degree(l.degree);
    for (Growth of : {Growth::of_mean, Growth::mean_square, Growth::almost_sure}) {  // all the same
      EXPECT_NEAR(real_limit(law, of), l.real, 1e-6);
      EXPECT_NEAR(imaginary_limit(law, of), l.imaginary, 1e-6);
    }
  }
}

TEST(StabilityLimit, OfFixedDegreesOnTheImaginaryAxisIsZeroButForThreeAndFourModuloFour) {
  for (int degree = 1; degree <= 24; ++degree)
    EXPECT_EQ(imaginary_limit(fixed_degree(degree), Growth::of_mean) > 0, degree % 4 == 0 || degree % 4 == 3)
        << degree;
}

TEST(StabilityLimit, HasThePublishedValuesInMeanSquare) {
  struct Limits {
    int min_degree, max_degree;
    double real, imaginary;
  };
  for (const Limits& l : {Limits{3, 6, 2.271943524, 0},
                          {4, 16, 2.679723847, 0},
                          {4, 8, 2.681177, 0},
                          {3, 4, 2.164948, 2.0},
                          {2, 3, 1.809316, 1.224744871},
                          {4, 7, 2.666689, 0.742438},
                          {5, 7, 3.081043, 1.505064},
                          {5, 8, 3.051061, 1.362638},
                          {6, 8, 3.460763, 2.438196},
                          {7, 8, 3.740767, 3.091116},
                          {0, 16, 1.064950, 0}}) {
    SCOPED_TRACE(::testing::Message() << "(" << l.min_degree << ", " << l.max_degree << ")");
    const TruncationLaw law = geometric_from(l.min_degree, l.max_degree, 0.5);
    EXPECT_NEAR(real_limit(law, Growth::mean_square), l.real, 1e-6);
    EXPECT_NEAR(imaginary_limit(law, Growth::mean_square), l.imaginary, 1e-6);
    EXPECT_GE(imaginary_limit(law, Growth::almost_sure), imaginary_limit(law, Growth::mean_square));
    EXPECT_GE(real_limit(law, Growth::almost_sure), real_limit(law, Growth::mean_square));
  }
}

TEST(StabilityLimit, IsTheRootOfEightTimesOneMinusPForDegreesThreeAndFour) {
  // |T_4|^2 - 1 = -y^6/72 + y^8/576 and delta_4 |S_4|^2 = p/(1-p) y^8/576: stable up to y^2 = 8 (1 - p).
  for (double p : {0.1, 0.5, 0.9})
    EXPECT_NEAR(imaginary_limit(geometric(3, 4, p), Growth::mean_square), std::sqrt(8 * (1 - p)), 1e-12);
}

TEST(StabilityLimit, DependsOnTheProbabilityWhereLossAndNoiseAreOfOneOrder) {
  // (2, 4): y^6 (-1/72 + d/36) + y^8 w_4/576, d = p/(1-p), w_4 = 1/(1-p)^2: stable for p < 1/3 up to
  // y^2 = 8 (1 - 2 d) / w_4.
  for (double p : {0.05, 0.2, 0.3}) {
    const double d = p / (1 - p);
    EXPECT_NEAR(imaginary_limit(geometric(2, 4, p), Growth::mean_square),
                std::sqrt(8 * (1 - 2 * d)) * (1 - p), 1e-12);
  }
  EXPECT_EQ(imaginary_limit(geometric(2, 4, 0.34), Growth::mean_square), 0.0);
  // (1, 3): y^4 (-1/12 + d/4) + y^6 w_3/36, w_3 = 1/(1-p)^2: stable for p < 1/4 up to y^2 = (3 - 9 d) / w_3.
  for (double p : {0.05, 0.2}) {
    const double d = p / (1 - p);
    EXPECT_NEAR(imaginary_limit(geometric(1, 3, p), Growth::mean_square), std::sqrt(3 - 9 * d) * (1 - p),
                1e-12);
  }
  EXPECT_EQ(imaginary_limit(geometric(1, 3, 0.26), Growth::mean_square), 0.0);
}

TEST(StabilityLimit, OfASingleRunIsTheRootOfItsTwoFactors) {
  // (3, 4): |R_3|^2 = 1 - y^4/12 + y^6/36, and |R_4|^2 with weight w = 1/(1-p) of the last term:
  // (1 - y^2/2 + w y^4/24)^2 + (y - y^3/6)^2. Stable while |R_3|^p |R_4|^(1-p) <= 1.
  for (double p : {0.3, 0.5, 0.7}) {
    const auto growth_at = [&](double y) {
      const double b = y - y * y * y / 6, c = 1 - y * y / 2, d = c + std::pow(y, 4) / 24 / (1 - p);
      return p * std::log(c * c + b * b) + (1 - p) * std::log(d * d + b * b);
    };
    const double limit = imaginary_limit(geometric(3, 4, p), Growth::almost_sure);
    ASSERT_GT(limit, 1.0);
    EXPECT_LT(growth_at(limit - 1e-9), 0);
    EXPECT_GT(growth_at(limit + 1e-9), 0);
    for (double y = 0.25; y < limit; y += 0.01) EXPECT_LT(growth_at(y), 0);
  }
}

TEST(StabilityLimit, RefusesDirectionsToTheRight) {
  const auto refused = ThrowsMessage<std::invalid_argument>(HasSubstr("imaginary axis"));
  for (Complex direction : {Complex(0), Complex(1, 1), Complex(NAN, 1)})
    EXPECT_THAT([&] { (void)stability_limit(fixed_degree(4), Growth::of_mean, direction); }, refused);
}

// ---- growths ----------------------------------------------------------------------------------------------

/// The three growths by enumeration of K in 100 digits.
using Digits100 = boost::multiprecision::cpp_bin_float_100;
struct Truth {
  Digits100 of_mean, mean_square, almost_sure;
};
Truth enumerated(int m, int n, const Digits100& p, const Complex& z) {
  const Digits100 x = z.real(), y = z.imag();
  Digits100 a = 1, b = 0, w = 1, survival = 1;  // term, weight, P(K >= k)
  Digits100 ra = 1, rb = 0, ta = 1, tb = 0;     // R_k, T_k
  Digits100 square = 0, logarithm = 0;
  for (int k = 0; k <= n; ++k) {
    if (k > 0) {
      const Digits100 next = (a * x - b * y) / k;
      b = (a * y + b * x) / k;
      a = next;
      if (k > m) w /= 1 - p;
      ra += w * a, rb += w * b, ta += a, tb += b;
    }
    if (k < m) continue;
    const Digits100 chance = k == n ? survival : Digits100(survival * p);
    survival *= 1 - p;
    square += chance * (ra * ra + rb * rb);
    logarithm += chance * log(Digits100(ra * ra + rb * rb)) / 2;
  }
  return {log(Digits100(ta * ta + tb * tb)) / 2, log(square) / 2, logarithm};
}

TEST(Growth, IsThatOfTheEnumerationToItsOwnDigits) {
  for (auto [m, n] : {std::pair{3, 6}, {3, 4}, {1, 3}, {0, 16}, {4, 16}, {8, 8}, {7, 12}})
    for (double p : {0.5, 0.75})  // 1 - p and all tails are exact
      for (Complex direction : {i, Complex(-1), Complex(-0.5, 0.8)})
        for (double r : {1e-3, 0.1, 1.0, 3.0}) {
          const Complex z = r * direction;
          SCOPED_TRACE(::testing::Message() << m << ", " << n << ", " << p << " at " << z);
          const TruncationLaw law = geometric_from(m, n, p);
          const Truth truth = enumerated(m, n, Digits100(p), z);
          const auto near = [&](Growth of, const Digits100& value) {
            // Of 80-bit numbers (2^-64), some 10 operations for each of up to 16 terms: one order of r is lost where the
            // leading term cancels on the imaginary axis, the factor e^{2r} of opposite signs on the real one.
            const double v = value.convert_to<double>(), lost = 160 * 0x1p-64 * (1 / r + std::exp(2 * r));
            const double size = r < 1.0 ? std::abs(v) : std::max(std::abs(v), 1.0);
            if (std::isfinite(v))
              EXPECT_NEAR(growth(law, of, z), v, 0x1p-53 * std::abs(v) + lost * size);
            else
              EXPECT_EQ(growth(law, of, z), v);  // log R_1(-1)
          };
          near(Growth::of_mean, truth.of_mean);
          near(Growth::mean_square, truth.mean_square);
          near(Growth::almost_sure, truth.almost_sure);
        }
}

TEST(Growth, OfTheEnergyOfAnOscillatorIsThePublishedOne) {
  // E|R|^2 - 1 = y^8/480 (1 + O(y^2)), of y^8 (1/576 + 1/2880);   y^10/14400.
  const auto energy = [](const TruncationLaw& law) {
    return std::expm1(2 * growth(law, Growth::mean_square, 0.1 * i));
  };
  EXPECT_NEAR(energy(geometric(3, 6, 0.5)), 2.0838e-11, 1e-15);
  EXPECT_NEAR(energy(geometric(4, 16, 0.5)), 6.947e-15, 1e-18);
}

TEST(Growth, OfALinearMotionUnderTheRulerIsTheAlmostSureOne) {
  // K = m + trailing zeros of a counter, at most N: over 2^20 steps each K < N occurs 2^20 P(K) times.
  struct Case {
    int m, n;
    Complex z;
  };
  for (const Case& c :
       {Case{3, 6, 0.5 * i}, {3, 6, 1.5 * i}, {4, 16, 2.0 * i}, {3, 4, 2.2 * i}, {3, 6, {-0.3, 1.0}}}) {
    SCOPED_TRACE(::testing::Message() << c.m << ", " << c.n << " at " << c.z);
    std::vector<Complex> factor;  // R_0 .. R_n
    Complex term = 1, sum = 1;
    for (int k = 0; k <= c.n; ++k) {
      if (k > 0) sum += (term *= c.z / double(k)) * std::ldexp(1.0, std::max(0, k - c.m));
      factor.push_back(sum);
    }
    constexpr unsigned steps = 1u << 20;
    Complex y = 1;
    double logarithm = 0;  // of what has been taken out of y
    for (unsigned counter = 1; counter <= steps; ++counter) {
      y *= factor[std::min(c.n, c.m + std::countr_zero(counter))];
      if (counter % 64 == 0) logarithm += std::log(std::abs(y)), y /= std::abs(y);
    }
    // The counts are exact; 2^20 rounded products add 2^-53 a step at most, far below 1e-12.
    EXPECT_NEAR(growth(geometric(c.m, c.n, 0.5), Growth::almost_sure, c.z), logarithm / steps, 1e-12);
  }
}

}  // namespace
}  // namespace jetlag::testing::stability_test
