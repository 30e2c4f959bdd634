// SPDX-License-Identifier: MIT
// Motions whose series end, vanish or do not exist: a finite step and the right state, or an error by name.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Lockstep jorba_zou(const System<double>& system) {
  return Lockstep(taylor(system, 20, std::make_unique<JorbaZou>()));
}

TEST(FreeFall, IsOneStepAsLongAsTheRun) {
  for (double until : {1e-9, 1.0, 1e9}) {
    Problem scene = free_fall();
    Lockstep lockstep = jorba_zou(scene.system);
    State<double> state = scene.start;
    ASSERT_EQ(lockstep.run(state, until, {}).outcome, Outcome::success);
    EXPECT_EQ(lockstep.work().steps, 1u);
    EXPECT_DOUBLE_EQ(state.position(0, 2), 3.0 + until * (4.0 + until * -9.75 / 2));
    EXPECT_DOUBLE_EQ(state.velocity(0, 2), 4.0 + until * -9.75);
  }
}

TEST(Rest, IsOneStepAsLongAsTheRun) {
  Problem scene = oscillator(1.0, 0.0, 0.0);
  Lockstep lockstep = jorba_zou(scene.system);
  ASSERT_EQ(lockstep.run(scene.start, 1e6, {}).outcome, Outcome::success);
  EXPECT_EQ(lockstep.work().steps, 1u);
  EXPECT_EQ(scene.start.position(0, 0), 0.0);
  EXPECT_EQ(scene.start.velocity(0, 0), 0.0);
}

TEST(Duffing, StartsAtTheOrigin) {
  System<double> system(1, {1.0});
  system.add<CubicTether>({{0}}, {{}});
  Lockstep lockstep = jorba_zou(system);
  State<double> state{0.0, Coordinates<double>::Zero(1, 1), Coordinates<double>::Ones(1, 1)};
  const Report report = lockstep.run(state, 1.0, {});
  ASSERT_EQ(report.outcome, Outcome::success) << report.message;
  // Reference: another program, to 15 digits; and a few steps of a few roundings.
  EXPECT_NEAR(state.position(0, 0), 0.804358357540461, 2e-15);
  EXPECT_LT(lockstep.work().steps, 10u);
}

TEST(CoincidentParticles, AreAnErrorThatNamesThem) {
  Problem scene = falling_together(0.0);
  const State<double> before = scene.start;
  const Report report = jorba_zou(scene.system).run(scene.start, 1.0, {});
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_THAT(report.message,
              AllOf(HasSubstr("coefficient 2 of the motion of particle 0"), HasSubstr("coincide")));
  EXPECT_EQ(scene.start.position, before.position);
}

}  // namespace
}  // namespace jetlag::testing
