// SPDX-License-Identifier: MIT
// Forces that depend on time, through whole runs: a driven oscillator, in and out of resonance, with drag.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::driven_oscillator_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// x'' = -own^2 x - friction x' + cos(driving t) on a line, from a state.
State<> driven(double own, double driving, double friction, State<> state, double until) {
  System<> system(1, {1.0});
  system.add<Tether>({{0}}, {{own * own}});
  system.add<Shaker>({{0}}, {{driving}});
  system.add<Drag>({{0}}, {{friction}});
  EXPECT_EQ(Lockstep(taylor(system, 20, std::make_unique<JorbaZou>())).run(state, until, {}).outcome,
            Outcome::success);
  return state;
}
State<> at(double time, double x, double v) {
  return {time, Coordinates<>::Constant(1, 1, x), Coordinates<>::Constant(1, 1, v)};
}

// Rounding: eps / 2 a step and, for the driving phase, eps driving t a unit of time: below 1e-14 t for t <= 50.

TEST(DrivenOscillator, BeatsOutOfResonance) {  // from rest: x = (cos 2t - cos 3t) / (3^2 - 2^2)
  for (double t : {1.0, 10.0, 50.0}) {
    const State<> end = driven(3, 2, 0, at(0, 0, 0), t);
    EXPECT_NEAR(end.position(0, 0), (std::cos(2 * t) - std::cos(3 * t)) / 5, 64 * t * eps) << t;
    EXPECT_NEAR(end.velocity(0, 0), (3 * std::sin(3 * t) - 2 * std::sin(2 * t)) / 5, 3 * 64 * t * eps) << t;
  }
}

TEST(DrivenOscillator, GrowsLinearlyInResonance) {  // x = t sin(2t) / 4
  for (double t : {1.0, 10.0, 50.0}) {
    const State<> end = driven(2, 2, 0, at(0, 0, 0), t);
    EXPECT_NEAR(end.position(0, 0), t * std::sin(2 * t) / 4, 64 * t * t * eps) << t;
    EXPECT_NEAR(end.velocity(0, 0), (std::sin(2 * t) + 2 * t * std::cos(2 * t)) / 4, 2 * 64 * t * t * eps)
        << t;
  }
}

TEST(DrivenOscillator,
     FollowsItsDriverUnderDragFromAnyTime) {  // x = Re A e^{2it},  A = 1 / (3^2 - 2^2 + 2 i c)
  const double friction = 0.5;
  const std::complex<double> amplitude = 1.0 / std::complex<double>(5, 2 * friction);
  const auto x = [&](double t) { return (amplitude * std::polar(1.0, 2 * t)).real(); };
  const auto v = [&](double t) {
    return (amplitude * std::polar(2.0, 2 * t) * std::complex<double>(0, 1)).real();
  };
  for (double begin : {-7.3, 0.0, 100.0}) {  // the phase at 100 is off by 200 eps, the rest dies out
    const State<> end = driven(3, 2, friction, at(begin, x(begin), v(begin)), begin + 20);
    EXPECT_NEAR(end.position(0, 0), x(begin + 20), 512 * eps) << begin;
    EXPECT_NEAR(end.velocity(0, 0), v(begin + 20), 1024 * eps) << begin;
  }
}

}  // namespace
}  // namespace jetlag::testing::driven_oscillator_test
