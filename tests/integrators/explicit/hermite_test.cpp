// SPDX-License-Identifier: MIT
// Hermite's method: what it is beyond the laws of all integrators.

#include "jetlag/integrators/explicit/hermite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jetlag/forces/drag.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::hermite_test {
namespace {

State<double> after(const Problem& scene, const Hermite::Options& options, double until,
                    Work* work = nullptr) {
  State<double> state = scene.start;
  Lockstep run(std::make_unique<Hermite>(scene.system, options));
  EXPECT_EQ(run.run(state, until, {}).outcome, Outcome::success);
  if (work != nullptr) *work = run.work();
  return state;
}

TEST(Hermite, ConvergedStepsAreThoseOfTheFourthPadeApproximation) {
  // y' = A y by Hermite's quadrature is y_1 = (1 + z/2 + z^2/12) / (1 - z/2 + z^2/12) y_0 for v, with z = i h on
  // x'' = -x; the corrector for x adds the same quadrature. So x turns by 2 atan((h/2) / (1 - h^2/12)), |z| kept.
  const double h = 0.25, angle = 2 * std::atan(h / 2 / (1 - h * h / 12));
  const State<double> end = after(oscillator(), {.iterations = 20, .step = h}, 40 * h);
  EXPECT_NEAR(end.position(0, 0), std::cos(40 * angle), 1e-13);  // 40 steps of a few roundings
  EXPECT_NEAR(end.velocity(0, 0), -std::sin(40 * angle), 1e-13);
}

TEST(Hermite, ConvergedStepsAreSymmetricSoTheEnergyDoesNotDrift) {
  // 200 periods of e = .3, 60 steps each: with one iteration the energy drifts, with eight it does not.
  const Problem scene = planet(0.3);
  const double period = 2 * std::numbers::pi;
  EnergyMeter energy(scene.system);
  const auto error = [&](int iterations, int periods) {
    const State<double> end = after(scene, {.iterations = iterations, .step = period / 60}, periods * period);
    return std::abs(energy(end).total() + 0.5);
  };
  EXPECT_GT(error(1, 200), 10 * error(1, 10));
  EXPECT_LT(error(8, 200), 2e-6);  // the error within a period: h^4 / 720 times derivatives of the planet
}

TEST(Hermite, AarsethsStepsFollowAnEccentricOrbit) {
  // h ~ sqrt(eta), the error ~ h^4: eta / 4 gives twice the steps and an error 16 times smaller.
  const Problem scene = planet(0.9);
  Work coarse, fine;
  const auto miss = [&](const State<double>& end) {
    return (end.position.row(1) - scene.start.position.row(1)).norm();
  };
  const double first = miss(after(scene, {.accuracy = 0.004}, 2 * std::numbers::pi, &coarse)),
               second = miss(after(scene, {.accuracy = 0.001}, 2 * std::numbers::pi, &fine));
  EXPECT_NEAR(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps), 2, 0.1);
  EXPECT_NEAR(std::log2(first / second), 4, 0.5);
  EXPECT_LT(fine.steps, 1000u);  // fixed steps of the length at the pericentre would be some 5000
}

TEST(Hermite, TheFirstStepNeedsNoGuess) {
  // On a circle of angular speed w all derivatives are w^k: h = sqrt(eta) / w, from the first step on.
  for (double omega : {1.0, 1e6, 1e-6}) {
    const Problem scene = circular_oscillator(omega);
    Hermite method(scene.system, {.accuracy = 0.01});
    State<double> state = scene.start;
    Report report;
    EXPECT_NEAR(method.step(state, 1e300, report) * omega, 0.1, 1e-14);
    EXPECT_NEAR(method.step(state, 1e300, report) * omega, 0.1,
                1e-3);  // from the interpolation, which is O(h^2) off
  }
}

TEST(Hermite, EvaluatesTwoOrdersIterationsPlusOneTimesAStep) {
  Work work;
  after(planet(0.1), {.iterations = 2, .step = 0.125}, 10.0, &work);
  EXPECT_EQ(work.steps, 80u);
  EXPECT_EQ(work.element_coefficients, 2u * 3 * 80);
}

TEST(Hermite, IsOfOrderFourWithDragAndWithForcesThatDependOnTime) {
  // v' = -c v from 1 and v' = cos(w t) from 0:  v = e^{-ct} and sin(w t) / w.
  Problem sliding = oscillator(0.0, 0.0, 1.0), shaken = oscillator(0.0, 0.0, 0.0);
  sliding.system.add<Drag>({{0}}, {{0.7}});
  shaken.system.add<Shaker>({{0}}, {{3.0}});
  const auto slope = [](const Problem& scene, double truth) {
    const auto error = [&](double h) {
      return std::abs(after(scene, {.step = h}, 2.0).velocity(0, 0) - truth);
    };
    return std::log2(error(1.0 / 32) / error(1.0 / 64));
  };
  EXPECT_NEAR(slope(sliding, std::exp(-1.4)), 4.0, 0.1);  // with one iteration: 3
  EXPECT_NEAR(slope(shaken, std::sin(6.0) / 3), 4.0, 0.1);
}

TEST(Hermite, RefusesWhatIsNotPositive) {
  const Problem scene = oscillator();
  EXPECT_THROW(Hermite(scene.system, {.iterations = 0}), std::invalid_argument);
  EXPECT_THROW(Hermite(scene.system, {.accuracy = 0.0}), std::invalid_argument);
  EXPECT_THROW(Hermite(scene.system, {.max_step = 0.0}), std::invalid_argument);
  EXPECT_THROW(Hermite(scene.system, {.step = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::hermite_test
