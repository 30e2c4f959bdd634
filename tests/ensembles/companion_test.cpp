// SPDX-License-Identifier: MIT
// The run beside an ensemble: where it stops, and that it goes no further.
#include "ensembles/companion.hpp"

#include <gtest/gtest.h>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/forces.hpp"

namespace jetlag::testing {
namespace {

/// x'' = -x from 1, in steps of 0.5 s.
class ACompanion : public ::testing::Test {
 protected:
  ACompanion() : system(1, {1.0, 1.0}) {
    system.fix(0);
    system.add<Spring>({{0, 1}}, {{1.0, 0.0}});
  }
  Companion until(double end, std::uint64_t max_steps = Companion::most_steps) const {
    return {system, {fixed_degree(20), {}, std::make_shared<FixedStep>(0.5)}, start, end, max_steps};
  }

  System<> system;
  const State<> start{0.0, Coordinates<>{{0}, {1}}, Coordinates<>{{0}, {0}}};
};

TEST_F(ACompanion, IsSeenWhereItIsAskedFor) {
  Companion run = until(2.0);
  for (const double time : {0.3, 1.0, 1.9, 2.0}) {
    ASSERT_TRUE(run.advance_to(time));
    EXPECT_EQ(run.state().time, time);
    EXPECT_NEAR(run.state().position(1, 0), std::cos(time), 1e-14);
  }
  EXPECT_EQ(run.work().steps, 4u);
}

TEST_F(ACompanion, TakesNoStepMoreThanItMay) {
  Companion run = until(10.0, 3);
  EXPECT_TRUE(run.advance_to(1.5));
  for (int again = 0; again < 2; ++again) {
    EXPECT_FALSE(run.advance_to(2.0));
    EXPECT_EQ(run.report().outcome, Outcome::step_limit);
    EXPECT_EQ(run.work().steps, 3u);
    EXPECT_EQ(run.time(), 1.5);
    EXPECT_EQ(run.state().time, 1.5);
  }
}

TEST_F(ACompanion, StopsWhereItIsAskedTo) {
  Companion run = until(10.0);
  EXPECT_FALSE(run.advance_to(2.0, [&] { return run.work().steps < 2; }));
  EXPECT_EQ(run.report().outcome, Outcome::interrupted);
  EXPECT_EQ(run.time(), 1.0);
  EXPECT_FALSE(run.advance_to(2.0));  // for good
}

}  // namespace
}  // namespace jetlag::testing
