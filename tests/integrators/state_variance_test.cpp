// SPDX-License-Identifier: MIT
// What a step scatters and how much energy it adds, against the enumeration of its degrees.

#include "jetlag/integrators/state_variance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/truncation/poisson.hpp"
#include "jetlag/truncation/single_term.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

const TruncationLaw laws[] = {geometric(2, 6, 0.5), poisson(2, 5, 1.0), single_term(geometric(2, 6, 0.5)),
                              fixed_degree(4)};
constexpr VelocitySeries conventions[] = {VelocitySeries::own_series, VelocitySeries::derivative};

/// f(state after a step that stops at degree k), its mean over k.
template <class X, class F>
X mean_over_degrees(const Expansion<double>& series, const TruncationLaw& law, double h,
                    VelocitySeries velocity, X sum, F f) {
  for (int k = 0; k <= law.max_degree(); ++k) {
    if (law.exactly(k) == 0.0) continue;
    State<double> state{h, 0.0 * series.position(0), 0.0 * series.velocity(0)};
    for (int n = 0; n <= k; ++n) {
      state.position += law.weight(n, k) * std::pow(h, n) * series.position(n);
      if (velocity == VelocitySeries::own_series)
        state.velocity += law.weight(n, k) * std::pow(h, n) * series.velocity(n);
      else if (n > 0)
        state.velocity += law.weight(n, k) * n * std::pow(h, n - 1) * series.position(n);
    }
    sum += law.exactly(k) * f(state);
  }
  return sum;
}

TEST(StateVariance, IsThatOfTheEnumeration) {
  const Problem scene = planet(0.3);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(7);
  const double h = 0.4;
  const Coordinates<double> zero = Coordinates<double>::Zero(2, 2);
  for (const TruncationLaw& law : laws)
    for (VelocitySeries velocity : conventions) {
      const auto mean = [&](auto f) { return mean_over_degrees(series, law, h, velocity, zero, f); };
      const auto x = mean([](const auto& s) { return s.position; }),
                 v = mean([](const auto& s) { return s.velocity; });
      const Coordinates<double> xx = mean([&](const auto& s) { return (s.position - x).cwiseAbs2().eval(); }),
                                vv = mean([&](const auto& s) { return (s.velocity - v).cwiseAbs2().eval(); });
      const StateVariance variance = state_variance(series, law, h, velocity);
      // Squares of numbers of size 1, known to some eps.
      EXPECT_LT((variance.position - xx).cwiseAbs().maxCoeff(), 1e-14) << law.name();
      EXPECT_LT((variance.velocity - vv).cwiseAbs().maxCoeff(), 1e-14) << law.name();
    }
}

TEST(RandomEnergy, IsWhatAnOscillatorGainsInTheMean) {  // quadratic: exact
  const Problem scene = oscillator(1.0, 0.6, 0.8);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(7);
  EnergyMeter meter(scene.system);
  for (const TruncationLaw& law : laws)
    for (VelocitySeries velocity : conventions)
      for (double h : {0.5, 1.5}) {
        const double mean = mean_over_degrees(series, law, h, velocity, 0.0,
                                              [&](const State<double>& s) { return meter(s).total(); });
        const auto fixed = mean_over_degrees(series, fixed_degree(law.max_degree()), h, velocity, 0.0,
                                             [&](const State<double>& s) { return meter(s).total(); });
        const double added = random_energy(scene.system, series, law, h, velocity);
        EXPECT_NEAR(added, mean - fixed, 1e-7 * added + 1e-14)
            << law.name() << ", " << h;  // the second difference
      }
}

TEST(RandomEnergy, AddsThePublishedEnergyToAnOscillator) {
  // (3, 6, 1/2) at y = .1, relative: y^8 (1/576 + 1/2880), less y^8/2880 by which T_6 grows itself; the next order in y
  // is 1 %.
  const Problem scene = oscillator(1.0, 0.6, 0.8);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(7);
  const double added = random_energy(scene.system, series, geometric(3, 6, 0.5), 0.1) / 0.5;
  EXPECT_NEAR(added, 1e-8 / 576, 0.02 * 1e-8 / 576);
}

TEST(RandomEnergy, IsTheFirstTermForAPlanet) {  // U is cubic beyond: an error of the size of S / |x|
  const Problem scene = planet(0.3);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(7);
  EnergyMeter meter(scene.system);
  const TruncationLaw law = geometric(2, 6, 0.5);
  const double h = 0.05;
  const auto total = [&](const State<double>& s) { return meter(s).total(); };
  const double truth = mean_over_degrees(series, law, h, VelocitySeries::own_series, 0.0, total) -
                       mean_over_degrees(series, fixed_degree(6), h, VelocitySeries::own_series, 0.0, total);
  EXPECT_NEAR(random_energy(scene.system, series, law, h), truth, 1e-3 * truth);
}

TEST(StateVariance, RefusesASeriesThatIsTooShort) {
  const Problem scene = planet(0.3);
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(4);
  EXPECT_THROW(state_variance(series, fixed_degree(4), 0.1), std::invalid_argument);
  EXPECT_NO_THROW(state_variance(series, fixed_degree(4), 0.1, VelocitySeries::derivative));
}

}  // namespace
}  // namespace jetlag::testing
