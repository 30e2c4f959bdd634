// SPDX-License-Identifier: MIT
// A Courant limit for each clock: soft parts of a scene may take long steps, stiff ones may not, and neither may become
// unstable where its motion is so smooth that the series ask for more.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

#include "jetlag/control/courant.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"

namespace jetlag::testing::clock_courant_test {
namespace {

/// Unit masses 1 .. 6 on a line between fixed ends, springs of stiffness 1, but 10000 between 3 and 4; a free one apart.
System<double> chain() {
  System<double> system(1, std::vector<double>(9, 1.0));
  system.fix(0);
  system.fix(7);
  for (int i = 0; i < 7; ++i) system.add<Spring>({{i, i + 1}}, {{i == 3 ? 1e4 : 1.0, 1.0}});
  return system;
}

/// omega^2 of a particle: the largest over its springs of the sum of stiffness / mass at both ends.
TEST(FrequencyBounds, AreThoseOfEachNeighbourhood) {
  const std::vector<double> omega = frequency_bounds(chain());
  const double loaded = 1 + 1e4;
  const double squares[] = {2, 4, 2 + loaded, 2 * loaded, 2 * loaded, 2 + loaded, 4, 2, 0};
  ASSERT_EQ(omega.size(), 9u);
  for (int i = 0; i < 9; ++i) EXPECT_DOUBLE_EQ(omega[i] * omega[i], squares[i]) << i;
  EXPECT_EQ(frequency_bound(chain()), *std::max_element(omega.begin(), omega.end()));
}

/// Degree 4 on the imaginary axis: 2 sqrt 2.
TEST(CourantStepsOfParticles, AreInverseToTheirFrequencies) {
  const std::vector<double> omega = frequency_bounds(chain()),
                            steps = courant_steps_of_particles(chain(), fixed_degree(4),
                                                               VelocitySeries::own_series, 0.5);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(steps[i] * omega[i], 0.5 * std::sqrt(8.0), 1e-8) << i;
  EXPECT_EQ(steps[8], std::numeric_limits<double>::infinity());
  EXPECT_THROW(courant_steps_of_particles(chain(), fixed_degree(6), VelocitySeries::own_series, 0.5),
               std::invalid_argument);
  EXPECT_THROW(courant_steps_of_particles(chain(), fixed_degree(4), VelocitySeries::own_series, 1.5),
               std::invalid_argument);
}

template <class Clocks>
class ClockCourant : public ::testing::Test {};
using Schedules = ::testing::Types<BlockSteps, Asynchronous>;
TYPED_TEST_SUITE(ClockCourant, Schedules);

/// At rest, but for a whisper of 1e-13 m that no tolerance sees: without a limit all would step as far as they may.
TYPED_TEST(ClockCourant, NoStepOfAParticleIsLonger) {
  const System<double> system = chain();
  State<double> state{0.0, Coordinates<double>::Zero(9, 1), Coordinates<double>::Zero(9, 1)};
  for (int i = 0; i < 9; ++i) state.position(i, 0) = i + 1e-13 * (i % 3);
  state.position(7, 0) = 7;
  state.position(0, 0) = 0;
  typename TypeParam::Options options;
  options.tolerance = 1e-9;
  options.courant = 0.9;
  const std::vector<double> longest =
      courant_steps_of_particles(system, fixed_degree(8), VelocitySeries::own_series, 0.9);
  TypeParam schedule(system, 8, options);
  RunOptions run;
  int updates = 0;
  run.observer.on_update = [&](const Update& update) {
    ++updates;
    EXPECT_LE(update.step, longest[update.particle]) << update.particle;
  };
  EXPECT_EQ(schedule.run(state, 10.0, run).outcome, Outcome::success);
  EXPECT_GT(updates, 100);
  if (std::is_same_v<TypeParam, Asynchronous>)
    return;  // which sees its neighbours' predictions: see ClockOptions
  // Stable: the energy, k/2 (3e-13)^2 or so, does not grow, so none strays further than sqrt(1e4) times its whisper.
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(state.position(i, 0), i, 1e-11) << i;
}

}  // namespace
}  // namespace jetlag::testing::clock_courant_test
