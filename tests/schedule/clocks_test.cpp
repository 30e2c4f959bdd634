// SPDX-License-Identifier: MIT
// What every schedule with a clock for each particle obeys, and one clock beside them: they converge to the same motion
// at the order of the method, run into collisions with open eyes, and are fast only where the motion is.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "schedule/networks.hpp"

namespace jetlag::testing::clocks_test {
namespace {

using ::testing::HasSubstr;

/// To rounding: another step rule, at degree 24.
State<double> truth(const Problem& scene, double until) {
  State<double> state = scene.start;
  Lockstep(taylor(scene.system, 24, std::make_unique<JorbaZou>())).run(state, until, {});
  return state;
}

// ---- the members ------------------------------------------------------------------------------------------

struct Member {
  std::string name;
  std::function<std::unique_ptr<Schedule>(const System<double>&, int degree, double tolerance)> make;
};
void PrintTo(const Member& member, std::ostream* out) { *out << member.name; }

template <class ScheduleType>
std::unique_ptr<Schedule> with_clocks(const System<double>& system, int degree, double tolerance) {
  typename ScheduleType::Options options;
  options.tolerance = tolerance;
  return std::make_unique<ScheduleType>(system, degree, options);
}
const Member lockstep{
    "Lockstep", [](const System<double>& system, int degree, double tolerance) {
      return std::make_unique<Lockstep>(taylor(system, degree, std::make_unique<LastTwo>(tolerance)));
    }};
const Member block{"Block", with_clocks<BlockSteps>}, asynchronous{"Asynchronous", with_clocks<Asynchronous>};

class Schedules : public ::testing::TestWithParam<Member> {};
INSTANTIATE_TEST_SUITE_P(, Schedules, ::testing::Values(lockstep, block, asynchronous),
                         [](const auto& info) { return info.param.name; });
class Clocks : public Schedules {};
INSTANTIATE_TEST_SUITE_P(, Clocks, ::testing::Values(block, asynchronous),
                         [](const auto& info) { return info.param.name; });

/// Of the line of least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::Map<const Eigen::ArrayXd> a(x.data(), x.size()), b(y.data(), y.size());
  return ((a - a.mean()) * (b - b.mean())).sum() / (a - a.mean()).square().sum();
}

// ---- laws -------------------------------------------------------------------------------------------------

TEST_P(Schedules, ConvergeAtTheirOrder) {
  // As the tolerance goes to zero the step is (tolerance / |c_{N-1}|)^(1/(N-1)), and the error of degree N goes with
  // h^N, as tolerance^(N/(N-1)). Steps on powers of two follow in stairs of 2^-(N-1) in the tolerance: the line of
  // least squares goes through as many of them as there are between coarse steps and rounding. Measured: within 0.1,
  // of degree 16 within 0.2, where few steps are small enough to be called so.
  const Problem scene = stiff_spot_in_a_chain(12, 50);  // frequencies from 0.2 to 14
  const double until = 2.0;
  const State<double> end = truth(scene, until);
  for (int degree : {4, 8, 12, 16}) {
    std::vector<double> x, y;  // log2 of tolerance and error
    for (double error = 1, tolerance = 0x1p-10; error > 2e-13 && tolerance > 0x1p-52; tolerance /= 2) {
      State<double> state = scene.start;
      ASSERT_EQ(GetParam().make(scene.system, degree, tolerance)->run(state, until, {}).outcome,
                Outcome::success);
      error = (state.position - end.position).cwiseAbs().maxCoeff();
      x.push_back(std::log2(tolerance));
      y.push_back(std::log2(error));
    }
    ASSERT_GT(x.size(), 10u);
    EXPECT_NEAR(slope(x, y), degree / (degree - 1.0), degree < 16 ? 0.15 : 0.25) << degree;
  }
}

TEST_P(Schedules, EndWhereTwoMassesFallIntoEachOther) {
  // The step shrinks with the time that is left, by a constant factor, until it no longer changes the time: a hundred
  // steps or so.
  for (double tolerance : {1e-6, 1e-12}) {
    const Problem scene = falling_together(1.0);
    State<double> state = scene.start;
    RunOptions options;
    options.max_steps = 10000;
    const Report report = GetParam().make(scene.system, 12, tolerance)->run(state, 3.0, options);
    EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
    EXPECT_NEAR(state.time, time_of_collision(1.0), 1e-6);
    EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
    EXPECT_THAT(report.message, HasSubstr("particle"));
    EXPECT_GE(report.particle, 0);
  }
}

TEST_P(Clocks, GoOnWithTheSameBits) {
  const Problem scene = stiff_spot_in_a_chain(16, 1e3);
  State<double> whole = scene.start, cut = scene.start;
  const Report at_once = GetParam().make(scene.system, 8, 1e-9)->run(whole, 1.0, {});
  const auto schedule = GetParam().make(scene.system, 8, 1e-9);
  RunOptions few;
  few.max_steps = 13;
  int stops = -1;
  std::uint64_t steps = 0;
  Report report{Outcome::step_limit, "", -1};
  for (; report.outcome == Outcome::step_limit; ++stops) {
    report = schedule->run(cut, 1.0, few);
    steps += report.steps;
    EXPECT_TRUE(report.outcome == Outcome::success || report.steps == 13);
  }
  EXPECT_GT(stops, 3);
  EXPECT_EQ(report.outcome, Outcome::success);
  EXPECT_EQ(at_once.outcome, Outcome::success);
  EXPECT_EQ(steps, at_once.steps);
  EXPECT_EQ(cut.position, whole.position);
  EXPECT_EQ(cut.velocity, whole.velocity);
}

// ---- a spring that collapses somewhere in a net ------------------------------------------------------------

/// A mass that falls through the fixed end of its spring at a distance of 1.5 offset (methods 13, H5), and a chain of
/// 20 that hangs on it by weak springs, away from it.
Problem collapsing(double offset) {
  constexpr int chain = 20;
  System<double> system(2, std::vector<double>(chain + 2, 1.0));
  system.fix(0);
  Problem scene{std::move(system),
                {0.0, Coordinates<double>::Zero(chain + 2, 2), Coordinates<double>::Zero(chain + 2, 2)}};
  scene.system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  scene.start.position.row(1) << 1.0, 0.0;
  scene.start.velocity.row(1) << -1.2, offset;
  std::vector<std::array<int, 2>> pairs;
  for (int i = 2; i < chain + 2; ++i) {
    pairs.push_back({i - 1, i});
    scene.start.position.row(i) << 1.0 + 5.0 * (i - 1), 0.0;
  }
  scene.system.add<LinearSpring>(pairs, {{1e-3}});
  return scene;
}

TEST_P(Clocks, AreFastOnlyWhereASpringCollapses) {
  for (double offset : {1e-1, 1e-3, 1e-6, 0.0}) {
    const Problem scene = collapsing(offset);
    State<double> state = scene.start;
    const auto schedule = GetParam().make(scene.system, 12, 1e-9);
    ASSERT_EQ(schedule->run(state, 2.0, {}).outcome, Outcome::success);
    EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite());
    const auto& clocks = dynamic_cast<const ParticleClocks&>(*schedule);
    for (int i = 2; i < 21; ++i) EXPECT_LE(clocks.updates_of(i + 1), clocks.updates_of(i)) << i;
    // The tolerance is one of positions: while an acceleration of 1 m/s^2 moves the mass by less than it, the force
    // may do what it likes, here turn round. That is a velocity of 2 sqrt(2 tolerance) at most, for a second.
    if (offset > 0) {
      const State<double> end = truth(scene, 2.0);
      EXPECT_LT((state.position - end.position).cwiseAbs().maxCoeff(), 2 * std::sqrt(2 * 1e-9));
    }
  }
}

}  // namespace
}  // namespace jetlag::testing::clocks_test
