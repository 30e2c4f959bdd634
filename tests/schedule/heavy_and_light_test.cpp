// SPDX-License-Identifier: MIT
// What clocks of their own are worth to a heavy mass that is shaken by a light, fast one (methods 13, H3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::heavy_and_light_test {
namespace {

/// One run: updates of both masses, the largest error of the energy at a hundred times, and the end.
struct Ran {
  double heavy, light, energy_error = 0;
  State<double> end;
  double ratio() const { return light / heavy; }
};
Ran ran(const Problem& scene, ParticleClocks& schedule, double until) {
  EnergyMeter meter(scene.system);
  const double energy = meter(scene.start).total();
  Ran ran{0, 0, 0, scene.start};
  RunOptions options;
  for (int frame = 1; frame <= 100; ++frame) options.observer.frame_times.push_back(until * frame / 100);
  options.observer.at_frame = [&](const State<double>& state) {
    ran.energy_error = std::max(ran.energy_error, std::abs(meter(state).total() - energy));
  };
  EXPECT_EQ(schedule.run(ran.end, until, options).outcome, Outcome::success);
  ran.heavy = static_cast<double>(schedule.updates_of(1));
  ran.light = static_cast<double>(schedule.updates_of(2));
  return ran;
}

BlockSteps block(const Problem& scene, int degree, int grading, double tolerance = 1e-10) {
  BlockSteps::Options options;
  options.tolerance = tolerance;
  options.grading = grading;
  return {scene.system, degree, options};
}

// x of both masses after 1 s.         Source: the closed form in 75 digits, methods 13, H3.
constexpr double heavy_after_1 = 0.8414702947474279095532, light_after_1 = 0.8406439751772336314111;

TEST(HeavyAndLight, HaveStepsInTheRatioOfTheirLastCoefficients) {
  // The heavy mass is driven: its own motion holds 1e-9 cos(1000 t), and from order 3 on that is all its series consists of,
  // 1e-6 of the light one's. So its steps are longer by the root of 1e6 of the order that decides, N - 1 or N; each is
  // rounded down to a power of two. At degree 4 that is 100, and no more than 2 at degree 20: the polynomial of so high
  // a degree follows the shaking, however small, for a few of its radians, and is no motion at all beyond.
  const Problem scene = light_mass();
  for (const int degree : {4, 6, 8, 12, 16, 20}) {
    auto schedule = block(scene, degree, 0);
    const double ratio = ran(scene, schedule, 1.0).ratio();
    EXPECT_GT(ratio, 0.5 * std::pow(1e6, 1.0 / degree)) << degree;
    EXPECT_LT(ratio, 2 * std::pow(1e6, 1.0 / (degree - 1))) << degree;
    if (degree == 4) {
      EXPECT_GT(ratio, 100);
    }
  }
}

TEST(HeavyAndLight, AreWithinAFactorByTheGrading) {
  // Each is the other's neighbour: 2^grading, unless the series ask for less. A free clock outlasts the
  // light one's step by half of it at most.
  const Problem scene = light_mass();
  for (const int grading : {1, 2, 3}) {
    auto schedule = block(scene, 6, grading);
    EXPECT_NEAR(ran(scene, schedule, 1.0).ratio(), std::ldexp(1.0, grading), 0.02 * std::ldexp(1.0, grading));
  }
  Asynchronous::Options options;
  options.tolerance = 1e-10;
  Asynchronous free_clocks(scene.system, 6, options);
  const double ratio = ran(scene, free_clocks, 1.0).ratio();
  EXPECT_GE(ratio, 1.0);
  EXPECT_LE(ratio, 1.5);
}

TEST(HeavyAndLight, PayForARatioOfAHundredWithAccuracyAndWork) {
  // The rule makes the last term as large as the tolerance; the first one left out is smaller by omega h / (N + 1): for the
  // light mass, omega h = 5e-3, a thousandth; for the heavy one, a hundred times longer, a tenth, and its velocity is off
  // by that over h, 2e-9 m/s, 2000 times. With the grading of 1 its steps are as good as the light one's, and
  // degree 8 with it has a twelfth of the work besides.
  const Problem scene = light_mass();
  auto hundred = block(scene, 4, 0), graded = block(scene, 4, 1), high = block(scene, 8, 1);
  const Ran a = ran(scene, hundred, 1.0), b = ran(scene, graded, 1.0), c = ran(scene, high, 1.0);
  EXPECT_LT(a.energy_error, 1e-6);
  for (const Ran* run : {&b, &c}) {
    EXPECT_NEAR(run->end.position(1, 0), heavy_after_1, 1e-12);  // measured: 1e-14
    EXPECT_NEAR(run->end.position(2, 0), light_after_1,
                1e-10);  // measured: 1.5e-11, the tolerance being 1e-10
    EXPECT_LT(run->energy_error, 1e-12);
  }
  EXPECT_GT(std::abs(a.end.position(1, 0) - heavy_after_1), 1e-10);  // measured: 9e-8
  EXPECT_LT(high.work().element_coefficients, hundred.work().element_coefficients / 12);
}

TEST(HeavyAndLight, AreUpdatedAlikeWhereBothAreFast) {
  // Equal masses, a stiff spring between them: they shake each other by as much.
  const Problem scene = stiff_spring();
  auto schedule = block(scene, 16, 0, 1e-13);
  const Ran run = ran(scene, schedule, 100.0);
  EXPECT_EQ(run.heavy, run.light);
  // Source: methods 13, H3. A phase error of the fast mode, of 0.7 m/s, is that of time: 1e5 steps that round t to
  // 1.4e-14 s at most, which is 4e-12 s in a random walk; truncation adds as much as the tolerance by a rounding each.
  EXPECT_NEAR(run.end.position(1, 0), 0.7062645918419748759951, 1e-10);
  EXPECT_NEAR(run.end.position(2, 0), 0.7074878714915396950005, 1e-10);
}

}  // namespace
}  // namespace jetlag::testing::heavy_and_light_test
