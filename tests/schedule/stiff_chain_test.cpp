// SPDX-License-Identifier: MIT
// A chain of 128 masses with four springs 1e4 times stiffer: what clocks of their own save, and what they cost.
//
// The soft chain has frequencies up to 2: beyond h = 3.3 / 2 a Taylor step of degree 16 is unstable there, and no step
// control sees that in a smooth motion. So nobody steps further than 1.25 s.
// Source of the case: methods 15b.

#include <gtest/gtest.h>

#include <memory>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "schedule/networks.hpp"

namespace jetlag::testing::stiff_chain_test {
namespace {

constexpr double max_step = 1.25;

/// Degree 20 in steps of 1/200 s: the fastest frequency is 190, (0.95)^21 / 21! = 7e-21.
State<double> truth(const Problem& scene, double until) {
  State<double> state = scene.start;
  Lockstep(taylor(scene.system, 20, std::make_unique<FixedStep>(0.005))).run(state, until, {});
  return state;
}

struct Result {
  Work work;
  double error;  // the largest of a position [m]
};
Result result(Schedule& schedule, const Problem& scene, const State<double>& truth) {
  State<double> state = scene.start;
  EXPECT_EQ(schedule.run(state, truth.time, {}).outcome, Outcome::success);
  return {schedule.work(), (state.position - truth.position).cwiseAbs().maxCoeff()};
}

struct Case {
  int degree;
  double tolerance, until;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "degree " << c.degree; }
class StiffSpot : public ::testing::TestWithParam<Case> {
 protected:
  const Problem scene = stiff_spot_in_a_chain(128, 1e4);
  const State<double> end = truth(scene, GetParam().until);
  Result lockstep() const {
    if (GetParam().degree ==
        4) {  // takes 3 s; measured with the lines below, and in methods 15b: 8.1e7 and 1.5e-7
      Work work;
      work.updates = 26860672;
      work.element_coefficients = 81211563;
      return {work, 1.51e-7};
    }
    RandomTaylor::Options options;
    options.velocity = VelocitySeries::derivative;
    Lockstep schedule(
        std::make_unique<RandomTaylor>(scene.system, fixed_degree(GetParam().degree),
                                       std::make_unique<LastTwo>(GetParam().tolerance, max_step), options));
    return result(schedule, scene, end);
  }
  template <class ScheduleType>
  Result of() const {
    typename ScheduleType::Options options;
    options.tolerance = GetParam().tolerance;
    options.max_step = max_step;
    options.velocity = VelocitySeries::derivative;
    ScheduleType schedule(scene.system, GetParam().degree, options);
    return result(schedule, scene, end);
  }
};
INSTANTIATE_TEST_SUITE_P(, StiffSpot,
                         ::testing::Values(Case{4, 1e-9, 20}, Case{8, 1e-9, 20}, Case{12, 1e-12, 20},
                                           Case{16, 1e-12, 20}));

TEST_P(StiffSpot, CostsBlockStepsATenthOfLockstep) {
  // Measured, at 20 s: 13.3, 11.4, 11.4, 10.7 times less; 1.13, 0.46, 0.94, 0.22 times the error.
  const Result one = lockstep(), block = of<BlockSteps>();
  EXPECT_GE(one.work.element_coefficients, 10 * block.work.element_coefficients);
  EXPECT_LE(block.error, 1.5 * one.error);
}

TEST_P(StiffSpot, CostsFreeClocksATwelfthOfTheUpdates) {
  // Measured, at 20 s: 14.3, 13.8, 11.5, 8.2 times fewer; 1.07, 1.00, 0.30, 0.34 times the error.
  const Result one = lockstep(), free = of<Asynchronous>();
  RecordProperty("updates", std::to_string(static_cast<double>(one.work.updates) / free.work.updates));
  RecordProperty("error", std::to_string(free.error / one.error));
  if (GetParam().degree <= 8) {
    EXPECT_GE(one.work.updates, 12 * free.work.updates);
    EXPECT_LE(free.error, 5 * one.error);
  } else {
    // Steps may outlast a neighbour's by 5/12 and 5/16 of what its series asks for, no longer by half.
    EXPECT_GE(one.work.updates, 8 * free.work.updates);
    EXPECT_LE(free.error, one.error);
  }
}

}  // namespace
}  // namespace jetlag::testing::stiff_chain_test
