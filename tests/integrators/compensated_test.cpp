// SPDX-License-Identifier: MIT
// Compensated sums: the state keeps what rounding cuts off.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "support/digits50.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::compensated_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double eps = std::numeric_limits<double>::epsilon();

std::unique_ptr<RandomTaylor> integrator(const System<double>& system, TruncationLaw law, double step,
                                         RandomTaylor::Options options = {}) {
  options.compensated = true;
  return std::make_unique<RandomTaylor>(system, std::move(law), std::make_unique<FixedStep>(step), options);
}

Problem drifting(double x, double v) {
  return {System<double>(1, {1.0}),
          {0.0, Coordinates<double>::Constant(1, 1, x), Coordinates<double>::Constant(1, 1, v)}};
}

TEST(CompensatedSums, KeepTwiceTheDigits) {
  // x = 1/3 + 0.1 n h up to 10: in plain sums every step rounds alike, by up to 9e-16. The rests are below 9e-16
  // themselves, and each step rounds theirs twice.
  const double h = 0.001;
  const int steps = 100'000;
  const Problem scene = drifting(1.0 / 3, 0.1);
  State<double> kept = scene.start, plain = scene.start;
  const auto compensated = integrator(scene.system, fixed_degree(2), h);
  const auto ordinary = taylor(scene.system, 2, std::make_unique<FixedStep>(h));
  Report report;
  for (int i = 0; i < steps; ++i) {
    compensated->step(kept, 1.0, report);
    ordinary->step(plain, 1.0, report);
  }
  const Digits50 truth = Digits50(scene.start.position(0, 0)) + Digits50(0.1) * steps * Digits50(h);
  ASSERT_EQ(kept.position_rest.size(), 1);
  const Digits50 sum = Digits50(kept.position(0, 0)) + Digits50(kept.position_rest(0, 0));
  EXPECT_LE(abs(sum - truth), steps * eps * 9e-16);
  EXPECT_GT(abs(plain.position(0, 0) - truth), 1e-12);
  EXPECT_EQ(kept.position(0, 0) + kept.position_rest(0, 0),
            kept.position(0, 0));  // below half of the last place
  EXPECT_EQ(plain.position_rest.size(), 0);
}

TEST(CompensatedSums, MovePositionsByTheRestsOfVelocities) {
  const Problem scene = drifting(1.0, 1.0);
  State<double> state = scene.start;
  state.velocity_rest = Coordinates<double>::Constant(1, 1, 0x1p-60);
  state.position_rest = Coordinates<double>::Constant(1, 1, -0x1p-58);
  Report report;
  EXPECT_EQ(integrator(scene.system, fixed_degree(3), 0.5)->step(state, 1.0, report), 0.5);
  ASSERT_EQ(state.position_rest.size(), 1);
  EXPECT_EQ(state.position(0, 0), 1.5);
  EXPECT_EQ(state.position_rest(0, 0), 0x1p-61 - 0x1p-58);
  EXPECT_EQ(state.velocity(0, 0), 1.0);
  EXPECT_EQ(state.velocity_rest(0, 0), 0x1p-60);
}

TEST(CompensatedSums, AreThePlainOnesToRounding) {
  // Random degrees for all and for each, both ways to take the velocity; 10 steps of a few roundings of numbers
  // below 2.
  const Problem scene = spring_cube(1);
  for (VelocitySeries velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    for (bool shared : {true, false}) {
      State<double> kept = scene.start, plain = scene.start;
      const RandomTaylor::Options options{1, shared, velocity};
      const auto compensated = integrator(scene.system, geometric(3, 8, 0.5), 0.125, options);
      RandomTaylor ordinary(scene.system, geometric(3, 8, 0.5), std::make_unique<FixedStep>(0.125), options);
      Report report;
      for (int i = 0; i < 10; ++i) {
        compensated->step(kept, 1.0, report);
        ordinary.step(plain, 1.0, report);
      }
      EXPECT_LT((kept.position - plain.position).cwiseAbs().maxCoeff(), 100 * eps) << "seed 1";
      EXPECT_LT((kept.velocity - plain.velocity).cwiseAbs().maxCoeff(), 100 * eps) << "seed 1";
      EXPECT_NE(kept.position, plain.position) << "seed 1";
    }
}

TEST(CompensatedSums,
     EndWhereAnotherMethodGoesOn) {  // a rest that is no longer that of its position is dropped
  const Problem scene = oscillator();
  for (int method : {0, 1}) {
    State<double> state = scene.start;
    Report report;
    integrator(scene.system, fixed_degree(8), 0.1)->step(state, 1.0, report);
    ASSERT_EQ(state.position_rest.size(), 1);
    ASSERT_EQ(state.velocity_rest.size(), 1);
    if (method == 0)
      Leapfrog(scene.system, 0.1).step(state, 1.0, report);
    else
      taylor(scene.system, 8, std::make_unique<FixedStep>(0.1))->step(state, 1.0, report);
    EXPECT_EQ(state.position_rest.size(), 0);
    EXPECT_EQ(state.velocity_rest.size(), 0);
  }
}

TEST(CompensatedSums, LeaveTheRestsAloneWhereAStepFails) {
  const Problem scene = falling_together(0.0);
  State<double> state = scene.start;
  state.position_rest = Coordinates<double>::Constant(2, 2, 0x1p-80);
  Report report;
  EXPECT_EQ(integrator(scene.system, fixed_degree(8), 0.1)->step(state, 1.0, report), 0.0);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_EQ(state.position_rest, (Coordinates<double>::Constant(2, 2, 0x1p-80)));
  EXPECT_EQ(state.velocity_rest.size(), 0);
}

TEST(CompensatedSums, RefuseRestsOfAnotherShape) {
  const Problem scene = oscillator();
  for (bool of_velocity : {false, true}) {
    State<double> state = scene.start;
    (of_velocity ? state.velocity_rest : state.position_rest).setZero(2, 1);
    Report report;
    const auto one = integrator(scene.system, fixed_degree(8), 0.1);
    EXPECT_THAT([&] { one->step(state, 1.0, report); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("rests, must have the shape (1, 1)")));
  }
}

TEST(CompensatedSums, RefuseAVelocityThatIsRandomFromItsFirstCoefficient) {
  // With `derivative` and K = 0 the velocity is zero, else v_0 / P(K >= 1) and more: no increment of v_0.
  const TruncationLaw law("from zero", {1.0, 0.5, 0.25});
  EXPECT_THAT([&] { integrator(oscillator().system, law, 0.1, {1, true, VelocitySeries::derivative}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("min_degree of at least 1")));
  EXPECT_NO_THROW(integrator(oscillator().system, law, 0.1));
}

}  // namespace
}  // namespace jetlag::testing::compensated_test
