// SPDX-License-Identifier: MIT
// Controls that wrap others: steps that end at kinks of forces, and below the Courant limit.
#include "jetlag/control/to_kinks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/floor.hpp"
#include "jetlag/motion/expansion.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const TruncationLaw law = fixed_degree(12);

/// A mass on a line at a height [m] above a floor, falling with 1 m/s and without gravity: it meets the floor after `height`
/// seconds, and its series ends.
Problem above_floor(double height) {
  Problem scene{
      System<double>(1, {1.0}),
      {0.0, Coordinates<double>::Constant(1, 1, height), Coordinates<double>::Constant(1, 1, -1.0)}};
  scene.system.add<Floor>({{0}}, {{100.0, 0.0, 1.0, 0.0, 0.0}});
  return scene;
}

double proposal(Control& control, const Problem& scene, double limit = infinity) {
  Expansion<double> series(scene.system);
  series.start(scene.start);
  series.grow_to(std::max(2, control.orders_read(law, VelocitySeries::own_series)));
  return control.propose({series, law, limit});
}

ToKinks to_kinks(const Problem& scene, std::unique_ptr<Control> inner) {
  return {scene.system, std::move(inner)};
}

TEST(ToKinks, EndsAChosenStepJustBeyondAKink) {
  for (const double height : {1.0, 0.3}) {
    const Problem scene = above_floor(height);
    auto control = to_kinks(scene, std::make_unique<LastTwo>(1e-9, 10.0));
    const double h = proposal(control, scene);  // at 1 m/s: within 1e-9 m of the kink, and beyond it
    EXPECT_GE(h, height);
    EXPECT_LE(h, height + 1.001e-9);
  }
}

TEST(ToKinks, LeavesAStepThatEndsBeforeAKink) {
  const Problem scene = above_floor(1.0);
  auto control = to_kinks(scene, std::make_unique<LastTwo>(1e-9, 0.75));
  EXPECT_EQ(proposal(control, scene), 0.75);
}

TEST(ToKinks, LeavesAStepThatIsGiven) {
  const Problem scene = above_floor(1.0);
  auto control = to_kinks(scene, std::make_unique<FixedStep>(3.0));
  EXPECT_TRUE(control.is_given());
  EXPECT_EQ(proposal(control, scene), 3.0);
}

TEST(ToKinks, DoesNotGoBeyondTheLimit) {
  const Problem scene = above_floor(1.0);
  auto chosen = to_kinks(scene, std::make_unique<LastTwo>(1e-9, 10.0));
  auto given = to_kinks(scene, std::make_unique<FixedStep>(3.0));
  EXPECT_EQ(proposal(chosen, scene, 0.5), 0.5);
  EXPECT_EQ(proposal(given, scene, 0.5), 0.5);
  EXPECT_EQ(proposal(given, scene, 3.0 + 1e-10), 3.0 + 1e-10);  // no tiny last step remains
}

TEST(ToKinks, IsTheOtherControlWhereThereAreNoKinks) {
  const Problem scene = planet(0.5);
  JorbaZou plain;
  auto control = to_kinks(scene, plain.clone());
  EXPECT_EQ(proposal(control, scene), proposal(plain, scene));
}

TEST(ToKinks, PassesOnWhatTheOtherSays) {
  const Problem scene = above_floor(1.0);
  const LastTwo inner(1e-9);
  const auto control = to_kinks(scene, inner.clone());
  for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    EXPECT_EQ(control.orders_read(law, velocity), inner.orders_read(law, velocity));
  EXPECT_EQ(control.past_kinks(), inner.past_kinks());
  EXPECT_FALSE(control.is_given());
}

TEST(ToKinks, MayWrapAnotherWrapper) {  // the Courant limit of 0.25 s first, then the kink
  const Courant inner(std::make_unique<LastTwo>(1e-9, 10.0), 0.5, 2.0, 4.0);
  const Problem far = above_floor(1.0), near = above_floor(0.2);
  auto control = to_kinks(far, inner.clone()), other = to_kinks(near, inner.clone());
  EXPECT_EQ(proposal(control, far), 0.25);
  EXPECT_NEAR(proposal(other, near), 0.2, 1.001e-9);
  EXPECT_TRUE(Courant(std::make_unique<FixedStep>(1.0), 0.5, 2.0, 4.0).is_given());
}

TEST(ToKinks, KnowsAsMuchAsItsClone) {
  const Problem scene = above_floor(1.0);
  auto control = to_kinks(scene, std::make_unique<LastTwo>(1e-9, 0.1));
  proposal(control, scene);
  control.left_at(scene.start.position);
  const auto clone = control.clone();
  EXPECT_EQ(proposal(*clone, scene), proposal(control, scene));
}

TEST(ToKinks, ForgetsParticlesThatOthersHaveMoved) {
  // What was seen from 1 m on, room for 0.5 m or so, must not serve a particle that has been put down at 1e-3 m.
  const Problem far = above_floor(1.0), near = above_floor(1e-3);
  auto control = to_kinks(far, std::make_unique<LastTwo>(1e-9, 0.1));
  proposal(control, far);
  control.left_at(far.start.position);
  EXPECT_NEAR(proposal(control, near), 1e-3, 1.001e-9);
}

TEST(ToKinks, GoesOnWithAnotherTrajectoryAndBack) {
  const Problem scene = above_floor(1.0);
  auto control = to_kinks(scene, std::make_unique<LastTwo>(1e-9, 0.1));
  ToKinks::Trajectory other;
  other.control = std::make_unique<LastTwo>(1e-9, 10.0);
  control.exchange(other);
  EXPECT_NEAR(proposal(control, scene), 1.0, 1.001e-9);
  control.exchange(other);
  EXPECT_EQ(proposal(control, scene), 0.1);
}

}  // namespace
}  // namespace jetlag::testing
