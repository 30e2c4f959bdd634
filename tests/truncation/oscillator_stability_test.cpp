// SPDX-License-Identifier: MIT
// Stability of randomly stopped series: q'' = -omega^2 q - c q', with both series of the velocity.

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/KroneckerProduct>

#include "jetlag/truncation/stability.hpp"
#include "support/eigenvalues.hpp"

namespace jetlag::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using enum VelocitySeries;

/// E[R_K (x) R_K] by enumeration of K, the first row of R_K from sum_{n<=K} w_n (hA)^n/n!, the second from its derivative
/// or from the same sum; in (omega q, v), where powers do not cancel.
template <class T>
Eigen::Matrix<T, 4, 4> second_moment(int m, int n, T p, VelocitySeries velocity, const Oscillator& o, T h) {
  using Matrix = Eigen::Matrix<T, 2, 2>;
  Matrix generator;
  generator << T(0), T(o.frequency) * h, -T(o.frequency) * h, -T(o.damping) * h;
  Matrix term = Matrix::Identity(), sum = term;
  if (velocity == derivative) sum.row(1).setZero();
  Eigen::Matrix<T, 4, 4> moment = Eigen::Matrix<T, 4, 4>::Zero();
  T survival(1), w(1);
  for (int k = 0; k <= n; ++k) {
    if (k > m) w /= T(1) - p;
    if (k > 0) {
      const Matrix next = term * generator / T(k);
      sum.row(0) += w * next.row(0);
      sum.row(1) += w * (velocity == derivative ? term : next).row(1);
      term = next;
    }
    if (k < m) continue;
    moment += (k == n ? survival : T(survival * p)) * Eigen::kroneckerProduct(sum, sum).eval();
    survival *= T(1) - p;
  }
  return moment;
}

TEST(OscillatorGrowth, OfTheEnergyIsThePublishedOneForBothVelocities) {
  const auto energy = [](VelocitySeries velocity) {
    return std::expm1(2 * growth(geometric(3, 6, 0.5), Growth::mean_square, velocity, {1.0, 0.0}, 0.1));
  };
  EXPECT_NEAR(energy(own_series), 2.0838e-11, 1e-15);
  EXPECT_NEAR(energy(derivative), 1.52952e-8, 1e-13);
}

TEST(OscillatorGrowth, IsThatOfTheEnumeration) {
  for (auto [m, n] : {std::pair{3, 6}, {1, 2}, {3, 4}, {5, 8}, {6, 6}})
    for (VelocitySeries velocity : {own_series, derivative})
      for (Oscillator o : {Oscillator{1.0, 0.0}, {2.0, 0.5}, {1.0, 1.999}, {1.0, 2.0}, {1.0, 3.0}})
        for (double h : {0.1, 0.6, 1.3}) {
          SCOPED_TRACE(::testing::Message() << m << ", " << n << ", " << int(velocity) << " at "
                                            << o.frequency << ", " << o.damping << ", " << h);
          const double truth = 0.5 * std::log(spectral_radius(second_moment(m, n, 0.5, velocity, o, h)));
          // Eigenvalues that nearly meet, as for c = 2 omega, are known to the root of rounding.
          EXPECT_NEAR(growth(geometric(m, n, 0.5), Growth::mean_square, velocity, o, h), truth,
                      std::abs(o.damping - 2 * o.frequency) < 0.01 ? 1e-4 : 1e-12);
        }
}

TEST(OscillatorGrowth, WithoutDampingHasItsOwnDigitsForTheSmallestSteps) {
  // Below rounding of 1 + growth: det(1 + g - E[R (x) R]) changes its sign between 0.999 and 1.001 of g, in 100 digits.
  using T = boost::multiprecision::cpp_bin_float_100;
  for (auto [m, n] : {std::pair{3, 6}, {4, 16}, {6, 7}})
    for (double h : {1e-3, 0.03}) {
      const double g =
          std::expm1(2 * growth(geometric(m, n, 0.5), Growth::mean_square, derivative, {1.0, 0.0}, h));
      const Eigen::Matrix<T, 4, 4> moment = second_moment<T>(m, n, T(0.5), derivative, {1.0, 0.0}, T(h));
      const auto determinant = [&](double share) {
        // On symmetric matrices, (p_11, p_12, p_22): of the antisymmetric one nothing is asked.
        Eigen::Matrix<T, 3, 3> a;
        const int of[] = {0, 1, 3};
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) a(r, c) = -moment(of[r], of[c]) - (c == 1 ? moment(of[r], 2) : T(0));
        for (int r = 0; r < 3; ++r) a(r, r) += T(1) + T(share) * T(g);
        return T(a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) -
                 a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
                 a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0)));
      };
      SCOPED_TRACE(::testing::Message() << m << ", " << n << " at " << h << ": " << g);
      EXPECT_LT(determinant(0.999) * determinant(1.001), T(0));
    }
}

TEST(OscillatorLimit, IsThatOfTheImaginaryAxisForTheOwnSeries) {
  for (auto [m, n] : {std::pair{3, 4}, {6, 8}, {3, 6}, {4, 4}})
    for (Growth of : {Growth::of_mean, Growth::mean_square, Growth::almost_sure})
      EXPECT_NEAR(stability_limit(geometric(m, n, 0.5), of, own_series, {2.0, 0.0}),
                  stability_limit(geometric(m, n, 0.5), of, std::complex<double>(0, 1)) / 2, 1e-12);
}

TEST(OscillatorLimit, OfTheDerivativeIsThatOfEulerAndOfTaylorTwo) {
  // Degree 1: q + h v, v (no force at all): stable, det = 1 and a double eigenvalue 1: the energy of a free flight.
  // Degree 2: q + h v - y^2/2 q, v - h w^2 q: trace 2 - y^2/2, det = 1 - y^2/2 + y^2 = 1 + y^2/2 > 1: never stable.
  EXPECT_EQ(stability_limit(fixed_degree(2), Growth::of_mean, derivative, {1.0, 0.0}), 0.0);
  // Degree 3: a = 1 - y^2/2, b = y - y^3/6; second row (-y, 1 - y^2/2): det = a^2 + y b = 1 + y^4/12, unstable.
  EXPECT_EQ(stability_limit(fixed_degree(3), Growth::of_mean, derivative, {1.0, 0.0}), 0.0);
  // Degree 4: a = 1 - y^2/2 + y^4/24, b = y - y^3/6; (-b, 1 - y^2/2): det = 1 - y^4/24 + y^6/144 (1/36 - 1/48 = 1/144):
  // to y^2 = 6, where the trace, 2 - y^2 + y^4/24 = -2.5, is beyond -1 - det = -2 already. -1 first at
  // 1 + trace + det = 4 - y^2 + y^6/144 = 0.
  const double limit = stability_limit(fixed_degree(4), Growth::of_mean, derivative, {1.0, 0.0}),
               u = limit * limit;
  EXPECT_NEAR(4 - u + u * u * u / 144, 0, 1e-12);
  EXPECT_LT(u, 6);
}

constexpr double omega = 246.295092;  // [rad/s], the fastest of the bunny

TEST(BandLimit, IsThePublishedOneOfTheBunny) {
  // The table was made on a grid of steps, downwards: its own (3, 4) without damping is .00805 where 2 / omega = .00812.
  // Its .00538 for (6, 6), c = 1, `derivative` is none: no oscillation grows below .00565, see the next test.
  struct Row {
    int m, n;
    double c, own, of_derivative;
  };
  for (const Row& r : {Row{6, 6, 1.0, 0.00603, 0},
                       {3, 6, 1.0, 0.00443, 0.00303},
                       {6, 6, 0.2, 0.00470, 0.00377},
                       {3, 6, 0.2, 0.00352, 0.00225},
                       {4, 16, 0.2, 0.00525, 0.00392},
                       {3, 4, 0.2, 0.00805, 0},
                       {5, 8, 0.2, 0.00729, 0},
                       {3, 4, 0.0, 0.00805, 0},
                       {5, 8, 0.0, 0.00551, 0}}) {
    SCOPED_TRACE(::testing::Message() << r.m << ", " << r.n << ", c = " << r.c);
    const TruncationLaw law = geometric(r.m, r.n, 0.5);
    EXPECT_NEAR(band_stability_limit(law, own_series, {omega, r.c}), r.own, 0.016 * r.own);
    if (r.of_derivative > 0) {
      EXPECT_NEAR(band_stability_limit(law, derivative, {omega, r.c}), r.of_derivative,
                  0.016 * r.of_derivative);
    }
  }
  EXPECT_EQ(band_stability_limit(geometric(4, 16, 0.5), own_series, {omega, 0.0}), 0.0);
}

TEST(BandLimit, IsWhereTheFirstOfAllOscillationsGrows) {
  for (VelocitySeries velocity : {own_series, derivative})
    for (auto [m, n, c] : {std::tuple{3, 6, 0.2}, {6, 6, 1.0}}) {
      const double limit = band_stability_limit(geometric(m, n, 0.5), velocity, {omega, c});
      const auto largest = [&](double h) {
        double most = 0;
        for (int k = 1; k <= 200; ++k)
          most = std::max(most, spectral_radius(second_moment(m, n, 0.5, velocity, {omega * k / 200, c}, h)));
        return most;
      };
      SCOPED_TRACE(::testing::Message() << m << ", " << n << ", " << int(velocity) << ": " << limit);
      EXPECT_LE(largest(0.999 * limit), 1.0);
      EXPECT_GT(largest(1.001 * limit), 1.0);
    }
}

TEST(OscillatorGrowth, RefusesWhatHasNoAnswer) {
  EXPECT_THAT([] { (void)growth(geometric(3, 6, 0.5), Growth::almost_sure, derivative, {1.0, 0.0}, 0.1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("commute")));
  for (Oscillator bad : {Oscillator{0, 0}, {-1, 1}, {1, -1}, {NAN, 1}})
    EXPECT_THAT([&] { (void)growth(fixed_degree(4), Growth::of_mean, own_series, bad, 0.1); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("frequency and damping")));
}

}  // namespace
}  // namespace jetlag::testing
