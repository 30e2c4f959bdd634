// SPDX-License-Identifier: MIT
// Steps that are stable for all modes of bounded frequency and damping, against the eigenvalues of whole steps.
#include "jetlag/truncation/stable_rays.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "jetlag/truncation/stability.hpp"
#include "support/eigenvalues.hpp"
#include "support/random.hpp"

namespace jetlag::testing::stable_rays_test {
namespace {

using enum VelocitySeries;

constexpr std::array ratios{0.0, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0};

/// For C = b K: the largest omega_max h over all modes below, by zeta = b omega_max / 2 of `ratios`. Of an independent program.
struct OfProportional {
  int degree;
  std::array<double, ratios.size()> limit;
};
constexpr std::array proportional{
    OfProportional{2, {0, 0.8000, 1.0498, 1.5287, 2, 2, 0.5359}},
    OfProportional{3, {1.7321, 1.9880, 2.1540, 2.4393, 2.5217, 2.5127, 0.6733}},
    OfProportional{4, {2.8284, 2.9098, 2.9509, 2.8967, 2.6225, 2.7853, 0.7463}},
    OfProportional{7, {1.7644, 3.0834, 3.3882, 3.8493, 3.9054, 3.9541, 1.0595}},
    OfProportional{8, {3.3951, 3.9481, 4.1749, 4.3624, 4.1958, 4.3136, 1.1558}},
    OfProportional{12, {3.3794, 5.1372, 5.4506, 5.8209, 5.7461, 5.8228, 1.5602}}};

TEST(StableRays, AreNeverAboveTheLimitOfProportionalDamping) {
  // The rectangle knows no more than that: without damping, what the axis allows (nothing for degree 2); with much, a mode that
  // is damped as the fastest one and has no stiffness, lambda = -2 zeta omega in the place of -zeta omega (1 + sqrt(1 -
  // zeta^-2)): half of it at zeta = 1. Degree 7, whose axis allows the least beside its neighbours, has 0.446.
  for (const auto& [degree, limit] : proportional) {
    const StableRays rays(fixed_degree(degree));
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const double own = rays.step({1.0, 0.0, 2 * ratios[i]});
      SCOPED_TRACE(::testing::Message() << "degree " << degree << ", zeta = " << ratios[i] << ": " << own);
      EXPECT_LE(own, limit[i] + 5e-5);  // as they are rounded
      if (degree == 2)
        EXPECT_EQ(own, 0.0);
      else
        EXPECT_GE(own, 0.446 * limit[i] - 5e-5);
    }
    if (degree != 2) {
      EXPECT_NEAR(rays.step({1.0, 0.0, 0.0}), limit[0], 5e-5);
    }
  }
}

const std::array laws{fixed_degree(3),  fixed_degree(4),      fixed_degree(8),
                      fixed_degree(12), geometric(3, 4, 0.5), geometric(5, 8, 0.5)};

TEST(StableRays, LetNoModeOfTheRectangleGrowAndAreNotMuchShorter) {
  // Between two rays, 0.0245 apart, the lesser exit counts for the longer extent, which changes by 1 / tan(a) for each radian:
  // by 2.5 % at a = pi/4, and twice that nearer to the axis where exits change much.
  for (std::size_t law = 0; law < laws.size(); ++law) {
    const StableRays rays(laws[law]);
    for (const ModeBounds& bounds :
         {ModeBounds{1, 0, 0.1}, {1, 0, 0.6}, {2, 0, 4}, {1, 0, 9}, {1, 0.2, 0.5}, {1, 0.7, 5}, {1, 3, 5}}) {
      const double h = rays.step(bounds);
      SCOPED_TRACE(::testing::Message()
                   << "law " << law << ", " << bounds.frequency << ", " << bounds.least_damping << " to "
                   << bounds.most_damping << ": " << h);
      const auto grows = [&](double frequency, double damping, double step) {
        return growth(laws[law], Growth::mean_square, own_series, {frequency, damping}, step);
      };
      Uniform random(3);
      double most = -1;
      for (int n = 0; n < 2000; ++n)
        most = std::max(most, grows(bounds.frequency * std::sqrt(random(0, 1)),
                                    random(bounds.least_damping, bounds.most_damping), h));
      EXPECT_LE(most, 1e-15);
      double beyond = -1;
      for (int n = 0; n <= 400; ++n) {
        const double part = n / 400.0;
        beyond = std::max(
            {beyond,
             grows(bounds.frequency,
                   bounds.least_damping + part * (bounds.most_damping - bounds.least_damping), 1.05 * h),
             grows(bounds.frequency * part, bounds.most_damping, 1.05 * h)});
      }
      EXPECT_GT(beyond, 0);
    }
  }
}

/// A symmetric matrix with eigenvalues from 0 to `most`, both of them among these.
Eigen::MatrixXd positive(int n, double most, Uniform& random) {
  Eigen::MatrixXd root(n, n - 1);
  for (Eigen::Index i = 0; i < root.size(); ++i) root.data()[i] = random(-1, 1);
  const Eigen::MatrixXd square = root * root.transpose();
  return most / largest_eigenvalue(square) * square;
}

TEST(StableRays, HoldWhereStiffnessAndDampingHaveNoCommonModes) {
  // The step of the whole system, sum_n (hA)^n / n!, A = (0 1; -K -C): its spectral radius, found to some 1e-15 of a matrix of
  // twelve rows that is far from normal, at the step from the bounds alone. Twice that is too long for most.
  const int n = 6;
  Uniform random(11);
  int too_long = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double omega = 1.0, most = std::exp(random(-3, 3)), least = trial % 2 == 0 ? 0.0 : random(0, most);
    const Eigen::MatrixXd k = positive(n, omega * omega, random),
                          c = least * Eigen::MatrixXd::Identity(n, n) + positive(n, most - least, random);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = -k;
    a.bottomRightCorner(n, n) = -c;
    const int degree = trial % 3 == 0 ? 8 : 4;
    static const StableRays rays_4(fixed_degree(4)), rays_8(fixed_degree(8));
    const double h = (degree == 4 ? rays_4 : rays_8).step({omega, least, most});
    const auto radius = [&](double step) {
      Eigen::MatrixXd term = Eigen::MatrixXd::Identity(2 * n, 2 * n), sum = term;
      for (int j = 1; j <= degree; ++j) sum += term = term * (step * a) / j;
      return spectral_radius(sum);
    };
    EXPECT_LE(radius(h), 1 + 1e-6) << trial;  // both have the eigenvalue 0, of a Jordan block: sqrt(1e-13)
    too_long += radius(2 * h) > 1.01;
  }
  EXPECT_GT(too_long, 100);
}

TEST(StableRays, AgreeWithTheBandWhereAllAreDampedAlike) {
  for (int degree : {4, 6, 8})
    for (double damping : {0.1, 0.5, 1.5}) {
      const double band = band_stability_limit(fixed_degree(degree), own_series, {1.0, damping}),
                   own = StableRays(fixed_degree(degree)).step({1.0, damping, damping});
      EXPECT_LE(own, band * (1 + 1e-9)) << degree << ", " << damping;
      EXPECT_GE(own, 0.95 * band) << degree << ", " << damping;
    }
}

TEST(StableRays, OfWhatIsOnlyDampedAreThoseOfTheRealAxis) {  // 2, 2.5127.., 2.7852935634 of degrees 2, 3, 4
  const StableRays rays(fixed_degree(4));
  EXPECT_NEAR(rays.step({0.0, 0.0, 2.0}), 2.7852935634 / 2, 1e-10);
  EXPECT_NEAR(rays.step({0.0, 2.0, 2.0}), 2.7852935634 / 2, 1e-10);
  EXPECT_NEAR(StableRays(fixed_degree(2)).step({0.0, 0.0, 4.0}), 0.5, 1e-12);
  EXPECT_EQ(rays.step({0.0, 0.0, 0.0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace jetlag::testing::stable_rays_test
