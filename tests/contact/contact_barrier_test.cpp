// SPDX-License-Identifier: MIT
// Motions with barriers of contact, by Taylor's method with one clock.
#include "jetlag/contact/contact_barrier.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing::contact_barrier_test {
namespace {

constexpr double thickness = 0.1, stiffness = 1000;

/// Points that touch each other.
void add_points(System<double>& system, const Coordinates<double>& rest) {
  std::vector<int> all(system.particles());
  for (int i = 0; i < system.particles(); ++i) all[i] = i;
  add(system,
      ContactBarrier{
          .surface = Surface({}, {}, all), .rest = rest, .thickness = thickness, .stiffness = stiffness});
}

struct Motion {
  State<double> end;
  Report report;
  Work work;
};
Motion run(const System<double>& system, State<double> state, double until, int degree = 20,
           std::unique_ptr<Control> control = std::make_unique<JorbaZou>()) {
  Lockstep lockstep(taylor(system, degree, std::move(control)));
  const Report report = lockstep.run(state, until, {});
  return {state, report, lockstep.work()};
}

// ---- one bounce ------------------------------------------------------------------------------------------------

/// A unit mass that comes from 1 m towards a wall at 0, on a line.
Motion bounce(double v, int degree, std::unique_ptr<Control> control) {
  System<double> system(1, {1.0, 1.0});
  system.fix(0);
  const Coordinates<double> x{{0.0}, {1.0}};
  add_points(system, x);
  return run(system, {0.0, x, Coordinates<double>{{0.0}, {-v}}}, 2.2 / v, degree, std::move(control));
}

struct Bounce {
  double v, duration;  // of the contact, times v / thickness, by quadrature in 50 digits
  int steps;
};

class BarrierBounce : public ::testing::TestWithParam<Bounce> {};

TEST_P(BarrierBounce, GivesTheSpeedBackToRounding) {
  const auto [v, duration, steps] = GetParam();
  const Motion moved = bounce(v, 20, std::make_unique<JorbaZou>());
  ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
  // At its switch the barrier is k d^2 (1e-6)^3 from zero, on the way in and on the way out.
  const double missed = 2 * stiffness * thickness * thickness * 1e-18;
  EXPECT_NEAR(moved.end.velocity(1, 0), v, 1e-14 * v + 1.1 * missed / v);
  if (duration > 0) {
    // The switch with hysteresis makes the way longer or shorter by parts of 1e-6 of the thickness in which the force is 1e-12
    // of its size: nothing. Positions are of size 1 and there are some 40 steps.
    EXPECT_NEAR(moved.end.position(1, 0), 1.4 - duration * thickness, 1e-12);
  }
  EXPECT_LE(moved.work.steps, static_cast<unsigned>(steps));
}

INSTANTIATE_TEST_SUITE_P(Speeds, BarrierBounce,
                         ::testing::Values(Bounce{0.01, 0, 17}, Bounce{1, .41912219280745, 26},
                                           Bounce{10, 0, 33}, Bounce{100, 1.05551392292834, 39},
                                           Bounce{1e3, 0, 45}, Bounce{1e4, 1.49269878313055, 50}));

TEST(ContactBarrier, IsNotPassedHoweverLooseTheTolerance) {
  for (const double v : {1.0, 100.0, 1e4, 1e6})
    for (const int degree : {6, 12})
      for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
        const Motion moved = bounce(v, degree, std::make_unique<LastTwo>(tolerance));
        ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
        EXPECT_GT(moved.end.position(1, 0), 0);
        EXPECT_NEAR(moved.end.velocity(1, 0), v, 3e-2 * v) << v << " " << degree << " " << tolerance;
      }
}

// ---- two points in the plane -------------------------------------------------------------------------------------

struct Impact {
  double parameter, v_x, v_y;  // [m], of the first one afterwards [m/s], by quadrature in 50 digits
};

/// Masses 1 and 3 that meet at 1 and -1/2 m/s, the first one that far beside the other's way.
class Impacts : public ::testing::TestWithParam<Impact> {};

TEST_P(Impacts, TurnByTheAngleOfTheQuadrature) {
  const auto [parameter, v_x, v_y] = GetParam();
  for (const double max_step : {std::numeric_limits<double>::infinity(), 1.0, 0.1}) {
    System<double> system(2, {1.0, 3.0});
    const State<double> start{0.0, Coordinates<double>{{0, parameter}, {1, 0}},
                              Coordinates<double>{{1, 0}, {-0.5, 0}}};
    add_points(system, start.position);
    const Motion moved = run(system, start, 4.0, 20, std::make_unique<JorbaZou>(max_step));
    ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
    EXPECT_NEAR(moved.end.velocity(0, 0), v_x, 1e-12);
    EXPECT_NEAR(moved.end.velocity(0, 1), v_y, 1e-12);
    EXPECT_LE((momentum(system, moved.end) - momentum(system, start)).norm(), 1e-15);
    EXPECT_LE((angular_momentum(system, moved.end) - angular_momentum(system, start)).norm(), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Parameters, Impacts,
                         ::testing::Values(Impact{0, -1.25, 0},
                                           Impact{.03, -.9181347100470267, .7978485644021795},
                                           Impact{.09, .9815252433145627, .2030440491805848}));

// ---- regions ----------------------------------------------------------------------------------------------------

TEST(ContactBarrier, EndsStepsWhereAnotherRegionIsNearest) {
  System<double> system(2, {1.0, 1.0, 1.0});
  system.fix(0);
  system.fix(1);
  system.add<UniformField>({{2}}, {{0.0, -9.81, 0.0}});
  const State<double> start{0.0, Coordinates<double>{{0, 0}, {1, 0}, {.5, .095}},
                            Coordinates<double>{{0, 0}, {0, 0}, {1, -.3}}};
  add(system, ContactBarrier{.surface = Surface({}, {{0, 1}}, {2}),
                             .rest = start.position,
                             .thickness = thickness,
                             .stiffness = stiffness});
  const Motion moved = run(system, start, 0.8);
  ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
  EXPECT_NEAR(moved.end.position(2, 0), 1.328662787104, 1e-11);
  EXPECT_NEAR(moved.end.position(2, 1), -.239149334704, 1e-11);
  EXPECT_NEAR(moved.end.velocity(2, 0), 1.101053048697, 1e-11);
  EXPECT_NEAR(moved.end.velocity(2, 1), -2.537408826030, 1e-11);
  EnergyMeter energy(system);
  EXPECT_NEAR(energy(moved.end).total(), energy(start).total(), 1e-14 * energy(start).total());
}

// ---- rows of masses ------------------------------------------------------------------------------------------------

/// Unit masses in a row on a line, these gaps apart; the first one moves at 1 m/s.
Motion cradle(int masses, double gap) {
  System<double> system(1, std::vector<double>(masses, 1.0));
  State<double> start{0.0, Coordinates<double>(masses, 1), Coordinates<double>::Zero(masses, 1)};
  for (int i = 0; i < masses; ++i) start.position(i, 0) = gap * i;
  start.velocity(0, 0) = 1;
  add_points(system, start.position);
  return run(system, start, 3.0);
}

TEST(ContactBarrier, HandsTheMotionOnInACradle) {
  const Motion moved = cradle(5, 0.15);
  ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(moved.end.velocity(i, 0), i == 4 ? 1 : 0, 1e-12);
}

TEST(ContactBarrier, IsNotStoppedByMassesThatTouchAtRest) {
  const std::vector<double> three{-.004331777, .004350624, .999981154},
      five{-.004331821, -.000195498, -.000007999, .004555094, .999980224};
  for (const auto& expected : {three, five})
    for (const double part : {1.0, 1 + 1e-12, 1 - 1e-12}) {
      const int masses = static_cast<int>(expected.size());
      const Motion moved = cradle(masses, thickness * part);
      ASSERT_EQ(moved.report.outcome, Outcome::success) << moved.report.message;
      for (int i = 0; i < masses; ++i) EXPECT_NEAR(moved.end.velocity(i, 0), expected[i], 2e-9);
      EXPECT_LE(moved.work.steps, 150u);
    }
}

}  // namespace
}  // namespace jetlag::testing::contact_barrier_test
