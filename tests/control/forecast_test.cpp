// SPDX-License-Identifier: MIT
// Errors that are forecast from the first orders: what is saved, and what is promised all the same.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::forecast_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of 2000 steps of a springy cube: orders of the forces that are computed in a step, and the degree drawn.
struct Means {
  double orders, degree;
};
Means means(std::unique_ptr<Control> control, const TruncationLaw& law, VelocitySeries velocity) {
  Problem scene = spring_cube(1);
  std::size_t elements = 0;
  for (const auto& group : scene.system.elements()) elements += group.count();
  RandomTaylor integrator(scene.system, law, std::move(control), {.seed = 1, .velocity = velocity});
  Report report;
  for (int i = 0; i < 2000; ++i) {
    const double h = integrator.step(scene.start, infinity, report);
    EXPECT_GT(h, 0.0);
    scene.start.time += h;
  }
  const auto& work = integrator.work();
  return {static_cast<double>(work.element_coefficients) / 2000 / static_cast<double>(elements),
          work.mean_degree()};
}

TEST(Forecast, DoesNotMakeOrdersBeComputedThatWereNotDrawn) {
  // A draw of K needs K orders of the forces with `own_series` and K - 1 with `derivative`, where the control reads
  // m + 1 positions, m orders: one more than it needs in the steps that have K = m.
  using enum VelocitySeries;
  for (const TruncationLaw& law : {geometric(3, 16, 0.5), geometric(4, 16, 0.25)}) {
    const int m = law.min_degree();
    const auto target = [] { return std::make_unique<VarianceTarget>(0.01, 0.02, 1e-7, 1e-7); };
    const Means of_target = means(target(), law, own_series);
    EXPECT_DOUBLE_EQ(of_target.orders, of_target.degree);
    EXPECT_NEAR(of_target.degree, law.mean(),
                5 * 4 / std::sqrt(2000));  // 5 sigma of a geometric draw, sigma < 4
    const Means of_halving =
        means(std::make_unique<HalveDouble>(0.01, 0.02, 1e-18, 1e-12, m), law, own_series);
    EXPECT_DOUBLE_EQ(of_halving.orders, of_halving.degree);
    const Means of_derivative = means(target(), law, derivative);
    const double stopped_first = law.at_least(m) - law.at_least(m + 1);  // P(K = m)
    EXPECT_NEAR(of_derivative.orders, of_derivative.degree - 1 + stopped_first, 5 * 0.5 / std::sqrt(2000));
  }
}

TEST(Forecast, OfAGeometricSeriesIsExact) {
  // x'' = 2 x^3 from x = x' = 1 is 1/(1-t): all coefficients 1.
  System<double> system(1, {1.0});
  system.add<CubicPush>({{0}}, {{}});
  const TruncationLaw law = geometric(3, 16, 0.5);
  Expansion<double> series(system);
  series.start({0.0, Coordinates<double>::Ones(1, 1), Coordinates<double>::Ones(1, 1)});
  series.grow_to(orders_for_errors(law));
  for (double h : {0.01, 0.3, 0.9}) {
    std::vector<double> terms;
    for (int k = 0; k <= 16; ++k) terms.push_back(std::pow(h, k));
    // Powers by pow and roots of quotients of 1: a few roundings for each of 16 terms.
    EXPECT_NEAR(largest_position_variance({series, law}, h), variance(law, terms),
                1e-14 * variance(law, terms));
    EXPECT_NEAR(largest_position_bias({series, law}, h), std::pow(h, 15), 1e-14 * std::pow(h, 15));
  }
}

TEST(Forecast, OfAnOscillationIsNotBelowTheTruthAtAnyPhase) {
  // The terms of cos(t + phase) decay as 1/k!, faster than any geometric series.
  const TruncationLaw law = geometric(3, 16, 0.5);
  for (double phase = 0; phase < 6.3; phase += 0.1)
    for (double h : {0.1, 0.5}) {
      const Problem scene = oscillator(1.0, std::cos(phase), -std::sin(phase));
      Expansion<double> series(scene.system);
      series.start(scene.start);
      series.grow_to(17);
      std::vector<double> terms;
      for (int k = 0; k <= 16; ++k) terms.push_back(series.position(k)(0, 0) * std::pow(h, k));
      const double truth = variance(law, terms), forecast = largest_position_variance({series, law}, h);
      EXPECT_GE(forecast, truth) << phase;
      // And of use: the terms c_4 and c_5 at any phase, with what their geometric continuation adds.
      EXPECT_LE(forecast, 1.5 * 1.5 * std::pow(h, 8) / 576 * (1 + h)) << phase;
    }
}

TEST(Forecast, KeepsTheRealVarianceBelowItsTargetInARun) {
  // 10^4 steps of an oscillator on a line, where each coefficient vanishes twice a period: no limit cycle, no step of
  // another size than its neighbours by more than the control's own factors, and the true variance below the target.
  const TruncationLaw law = geometric(3, 16, 0.5);
  Problem scene = oscillator(1.0, 1.0, 0.0);
  VarianceTarget control(0.01, 10.0, 1e-7, 1e-7);
  Expansion<double> series(scene.system);
  double least = infinity, largest = 0;
  for (int i = 0; i < 10'000; ++i) {
    series.start(scene.start);
    series.grow_to(17);
    const double h = control.propose({series, law}), t = scene.start.time + h;
    std::vector<double> terms;
    for (int k = 0; k <= 16; ++k) terms.push_back(series.position(k)(0, 0) * std::pow(h, k));
    if (i > 100) {
      EXPECT_LE(std::sqrt(variance(law, terms)), 1e-7);
      least = std::min(least, h);
      largest = std::max(largest, h);
    }
    scene.start = {t, Coordinates<double>::Constant(1, 1, std::cos(t)),
                   Coordinates<double>::Constant(1, 1, -std::sin(t))};
  }
  // Near a zero of c_4 the term of order 5 rules, which allows steps longer by (1 / (q h))^(1/4).
  EXPECT_LT(largest / least, std::pow(0.25 * least, -0.25));
}

}  // namespace
}  // namespace jetlag::testing::forecast_test
