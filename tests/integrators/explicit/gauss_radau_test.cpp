// SPDX-License-Identifier: MIT
// Gauss-Radau integration: what it is beyond the laws of all integrators.

#include "jetlag/integrators/explicit/gauss_radau.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "jetlag/forces/drag.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::gauss_radau_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(GaussRadau, NodesAreTheZerosOfLegendrePolynomials) {
  // P_7(x) + P_8(x) at x = 2 h - 1, whose slope is below 40 there: the node is off by less than an ulp of 2.
  for (const double h : GaussRadau::node()) {
    const double x = 2 * h - 1;
    EXPECT_NEAR(boost::math::legendre_p(7, x) + boost::math::legendre_p(8, x), 0.0, 40 * 2 * eps) << h;
  }
}

/// Steps of 1/n of a period, the error after one.
double error_with(double e, int n) {
  const Problem scene = planet(e);
  State<double> state = scene.start;
  const double period = 2 * std::numbers::pi;
  Lockstep run(std::make_unique<GaussRadau>(scene.system, GaussRadau::Options{.step = period / n}));
  EXPECT_EQ(run.run(state, period, {}).outcome, Outcome::success);
  return (state.position.row(1) - kepler(e, period).position).norm();
}

TEST(GaussRadau, TheErrorFallsWithThePowerFifteen) {
  // e = .8 between 51 and 102 steps a period: 2e-6 and 1e-10. Longer steps do not see the pericentre, of shorter ones
  // rounding is left. The next terms of the error change the slope of 15 by less than 1.
  const double coarse = error_with(0.8, 51), fine = error_with(0.8, 102);
  EXPECT_NEAR(std::log2(coarse / fine), 15, 1.0) << coarse << " " << fine;
}

TEST(GaussRadau, KeepsTheEnergyOfAnEccentricOrbitToRounding) {
  // 100 periods of e = .9: the relative error of the energy is a random walk of roundings, below 1e-14 (Brouwer).
  const Problem scene = planet(0.9);
  State<double> state = scene.start;
  EnergyMeter energy(scene.system);
  const double start = energy(state).total();
  Lockstep run(std::make_unique<GaussRadau>(scene.system, GaussRadau::Options{}));
  ASSERT_EQ(run.run(state, 200 * std::numbers::pi, {}).outcome, Outcome::success);
  EXPECT_LT(std::abs(energy(state).total() / start - 1), 1e-13);
  const double steps = static_cast<double>(run.work().steps);
  EXPECT_LT(steps / 100, 250);                                                       // a period
  EXPECT_LT(static_cast<double>(run.work().element_coefficients) / steps / 7, 3.5);  // iterations
}

TEST(GaussRadau, FollowsDragAndForcesThatDependOnTime) {
  // x'' = -c x' + cos(w t) from rest:  v = (c cos wt + w sin wt - c e^{-ct}) / (c^2 + w^2).
  Problem scene = oscillator(0.0, 0.0, 0.0);
  scene.system.add<Drag>({{0}}, {{0.7}});
  scene.system.add<Shaker>({{0}}, {{3.0}});
  State<double> state = scene.start;
  Lockstep run(std::make_unique<GaussRadau>(scene.system, GaussRadau::Options{.max_step = 0.5}));
  ASSERT_EQ(run.run(state, 2.0, {}).outcome, Outcome::success);
  const double v = (0.7 * std::cos(6.0) + 3 * std::sin(6.0) - 0.7 * std::exp(-1.4)) / (0.49 + 9);
  EXPECT_NEAR(state.velocity(0, 0), v, 8 * eps);
}

TEST(GaussRadau, AnEncounterIsMetWithShorterSteps) {
  // Two bodies fall together from rest and are followed to a separation of some percent.
  const Problem scene = falling_together(1.0);
  State<double> state = scene.start;
  EnergyMeter energy(scene.system);
  const double start = energy(state).total();
  Lockstep run(std::make_unique<GaussRadau>(scene.system, GaussRadau::Options{}));
  ASSERT_EQ(run.run(state, 0.995 * time_of_collision(1.0), {}).outcome, Outcome::success);
  EXPECT_LT((state.position.row(1) - state.position.row(0)).norm(), 0.1);
  EXPECT_NEAR(energy(state).total(), start, 1e-12);
}

TEST(GaussRadau, TheMotionWithinAStepIsItsPolynomial) {
  const Problem scene = planet(0.1);
  GaussRadau method(scene.system, {.step = 0.25});
  State<double> state = scene.start;
  Report report;
  ASSERT_EQ(method.step(state, 1.0, report), 0.25);
  // x^(10) h^10 / 10! / 2^10, with derivatives of a planet below 10!.
  for (double t : {0.0625, 0.125, 0.1875})
    EXPECT_LT((method.piece().at(t).position.row(1) - kepler(0.1, t).position).norm(), 1e-9) << t;
}

TEST(GaussRadau, RefusesWhatIsNotPositive) {
  const Problem scene = oscillator();
  EXPECT_THROW(GaussRadau(scene.system, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(GaussRadau(scene.system, {.max_step = -1.0}), std::invalid_argument);
  EXPECT_THROW(GaussRadau(scene.system, {.step = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::gauss_radau_test
