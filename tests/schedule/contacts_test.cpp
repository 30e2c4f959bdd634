// SPDX-License-Identifier: MIT
// Contact with a floor, and springs whose ends meet: steps that a control chooses end at the kink of the force, so that
// the error is that of the tolerance, whatever lies beyond.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing::contacts_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Member {
  std::string name;
  std::function<std::unique_ptr<Schedule>(const System<double>&, double tolerance)> make;
};
void PrintTo(const Member& member, std::ostream* out) { *out << member.name; }

template <class ScheduleType>
std::unique_ptr<Schedule> with_clocks(const System<double>& system, double tolerance) {
  typename ScheduleType::Options options;
  options.tolerance = tolerance;
  return std::make_unique<ScheduleType>(system, 12, options);
}
std::unique_ptr<Schedule> in_lockstep(const System<double>& system, double tolerance) {
  return std::make_unique<Lockstep>(taylor(system, 12, std::make_unique<LastTwo>(tolerance)));
}
std::unique_ptr<Schedule> to_rounding(const System<double>& system, double) {
  return std::make_unique<Lockstep>(taylor(system, 20, std::make_unique<JorbaZou>()));
}

class Contacts : public ::testing::TestWithParam<Member> {};
INSTANTIATE_TEST_SUITE_P(Of, Contacts,
                         ::testing::Values(Member{"Lockstep", in_lockstep},
                                           Member{"Block", with_clocks<BlockSteps>},
                                           Member{"Asynchronous", with_clocks<Asynchronous>}),
                         [](const auto& info) { return info.param.name; });

class ContactsOfClocks : public Contacts {};
INSTANTIATE_TEST_SUITE_P(Of, ContactsOfClocks,
                         ::testing::Values(Member{"Block", with_clocks<BlockSteps>},
                                           Member{"Asynchronous", with_clocks<Asynchronous>}),
                         [](const auto& info) { return info.param.name; });

// ---- a mass that bounces ----------------------------------------------------------------------------------

/// From rest at 1 m above a floor: sqrt(2/g) down to a speed v, then s'' = g - w^2 s, s' = v, which takes
/// 2 (pi - atan(v w / g)) / w, and up again.
struct Bounce {
  static constexpr double g = 9.81, stiffness = 1e4;  // w = 100
  System<double> system{2, {1.0}};
  State<double> start{0.0, Coordinates<double>{{0.3, 1.0}}, Coordinates<double>{{0.0, 0.0}}};

  Bounce() {
    system.add<UniformField>({{0}}, {{0.0, -g, 0.0}});
    system.add<Floor>({{0}}, {{stiffness, 0.0, 0.0, 1.0, 0.0}});
  }
  static double period() {
    const double w = std::sqrt(stiffness), v = std::sqrt(2 * g);
    return 2 * v / g + 2 * (std::numbers::pi - std::atan(v * w / g)) / w;
  }
};

/// One bounce turns an error of the energy of e m^2/s^2 into one of the period of 2 e / (g v), v = 4.4, and n bounces move
/// the mass away from its rest at 1 m by g/2 (n 2 e / (g v))^2 and e / g. An update errs by a tolerance in its place, by 12
/// of them over its step h in its speed; that is most where h is shortest, but those steps, of a length of the way to
/// the surface, are ballistic. What matters are some 30 updates a bounce with steps of 0.01 s and more: e = 4.4 x 12 x 30 x
/// 100 tolerances at the most.
TEST_P(Contacts, OfABouncingMassAreThoseOfTheClosedForm) {
  const Bounce bounce;
  constexpr int bounces = 10;
  double before = 1;
  for (double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const double e = 4.4 * 12 * 30 * 100 * tolerance, late = bounces * 2 * e / (Bounce::g * 4.4);
    State<double> state = bounce.start;
    const auto schedule = GetParam().make(bounce.system, tolerance);
    ASSERT_EQ(schedule->run(state, bounces * Bounce::period(), {}).outcome, Outcome::success);
    const double error = std::abs(state.position(0, 1) - 1), speed = std::abs(state.velocity(0, 1));
    EXPECT_LE(error, Bounce::g / 2 * late * late + bounces * e / Bounce::g) << tolerance;
    EXPECT_LE(speed, Bounce::g * late) << tolerance;
    EXPECT_LE(speed, std::max(0.1 * before, 1e-9)) << tolerance;  // two digits at least become one
    EXPECT_EQ(state.position(0, 0), 0.3);
    before = speed;
  }
}

TEST(Contacts, AreEndsOfStepsToRounding) {
  // A thousand bounces. The surface is found to 512 eps of a metre below it, where the force of 1e4 x 1e-13 is 1e-9 of the
  // weight and lasts for 1e-13 / 4.4 s: nothing. So the energy has the rounding of a dozen steps a bounce, as 1e-16 g
  // each at random, and one at the surface, where the place has lost 1e-16 of 1 m by its own rounding: 1e-16 g.
  const Bounce bounce;
  EnergyMeter energy(bounce.system);
  State<double> state = bounce.start;
  double worst = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    worst = std::max(worst, std::abs(energy(view.state()).total() / Bounce::g - 1));
    return true;
  };
  const auto schedule = to_rounding(bounce.system, 0);
  ASSERT_EQ(schedule->run(state, 1000 * Bounce::period(), options).outcome, Outcome::success);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(schedule->work().steps, 20 * 1000u);
}

TEST_P(Contacts, BeginOnTheSurface) {
  // Exactly on it at 2 m/s into it, out of it, and at rest without weight.
  for (double speed : {-2.0, 2.0, 0.0}) {
    System<double> system(1, {1.0});
    system.add<Floor>({{0}}, {{1e4, 0.0, 1.0, 0.0, 0.0}});
    State<double> state{0.0, Coordinates<double>{{0.0}}, Coordinates<double>{{speed}}};
    ASSERT_EQ(GetParam().make(system, 1e-9)->run(state, 1.0, {}).outcome, Outcome::success);
    const double contact = speed < 0 ? std::numbers::pi / 100 : 0;
    EXPECT_NEAR(state.position(0, 0), std::abs(speed) * (1 - contact), 1e-7) << speed;
    EXPECT_NEAR(state.velocity(0, 0), std::abs(speed), 1e-7) << speed;
  }
}

// ---- neighbours -------------------------------------------------------------------------------------------

/// Ten masses in a row that fall together, one end first: who does not touch the floor itself must learn of it.
struct Row {
  static constexpr int count = 10;
  System<double> system{2, std::vector<double>(count, 1.0)};
  State<double> start{0.0, Coordinates<double>(count, 2), Coordinates<double>::Zero(count, 2)};

  Row() {
    std::vector<std::array<int, 1>> all;
    std::vector<std::array<int, 2>> pairs;
    for (int i = 0; i < count; ++i) {
      all.push_back({i});
      if (i > 0) pairs.push_back({i - 1, i});
      start.position.row(i) << 0.3 * i, 0.2 + 0.4 * i;
    }
    system.add<UniformField>(all, {{0.0, -9.81, 0.0}});
    system.add<Spring>(pairs, {{50.0, 0.5}});
    system.add<Floor>(all, {{1e4, 0.0, 0.0, 1.0, 0.0}});
  }
};

/// 9 wakers of a neighbour that is told of a contact too late would leave 1e-4; updates of a tolerance each, some of 12 of
/// them a step of 0.01 s in the speed, leave 1e-6 after 1 s, and that falls with the tolerance.
TEST_P(Contacts, AreToldToNeighbours) {
  const Row row;
  State<double> truth = row.start;
  ASSERT_EQ(to_rounding(row.system, 0)->run(truth, 1.0, {}).outcome, Outcome::success);
  EnergyMeter energy(row.system);
  for (double tolerance : {1e-7, 1e-9, 1e-11}) {
    State<double> state = row.start;
    const auto schedule = GetParam().make(row.system, tolerance);
    ASSERT_EQ(schedule->run(state, 1.0, {}).outcome, Outcome::success);
    const double error = (state.position - truth.position).cwiseAbs().maxCoeff();
    EXPECT_LE(error, 1e3 * tolerance) << tolerance;
    EXPECT_NEAR(energy(state).total() / energy(row.start).total(), 1, 1e3 * tolerance) << tolerance;
  }
}

TEST_P(ContactsOfClocks, GiveTheSameBitsWhereverARunIsStopped) {
  const Row row;
  State<double> end = row.start;
  const auto whole = GetParam().make(row.system, 1e-8);
  ASSERT_EQ(whole->run(end, 0.3, {}).outcome, Outcome::success);
  EXPECT_GT(whole->work().steps, 50u);
  for (std::uint64_t stop = 1; stop < whole->work().steps; stop += 3) {
    const auto schedule = GetParam().make(row.system, 1e-8);
    State<double> state = row.start;
    RunOptions options;
    options.max_steps = stop;
    ASSERT_EQ(schedule->run(state, 0.3, options).outcome, Outcome::step_limit) << stop;
    ASSERT_EQ(schedule->run(state, 0.3, {}).outcome, Outcome::success);
    ASSERT_EQ(state.position, end.position) << stop;
  }
}

TEST_P(Contacts, GiveTheSameBitsWhateverParticlesAreCalled) {
  const Row row;
  Problem scene{row.system, row.start};
  std::vector<int> number(Row::count);
  for (int i = 0; i < Row::count; ++i) number[i] = (i * 7 + 3) % Row::count;
  System<double> system(2, row.system.mass());
  for (Elements<double> elements : row.system.elements()) {
    for (int& i : elements.particles) i = number[i];
    system.add(elements.law, elements.particles, elements.parameters);
  }
  State<double> one = row.start, other = row.start;
  for (int i = 0; i < Row::count; ++i) other.position.row(number[i]) = row.start.position.row(i);
  ASSERT_EQ(GetParam().make(row.system, 1e-8)->run(one, 1.0, {}).outcome, Outcome::success);
  ASSERT_EQ(GetParam().make(system, 1e-8)->run(other, 1.0, {}).outcome, Outcome::success);
  for (int i = 0; i < Row::count; ++i) EXPECT_EQ(other.position.row(number[i]), one.position.row(i)) << i;
}

// ---- springs ----------------------------------------------------------------------------------------------

TEST(Contacts, OfTheEndsOfASpringComeAtTheTimesOfTheClosedForm) {
  // H5 with offset 0: unit mass, k = L = 1, from 1 to the other end at -1.2: on each side a harmonic motion about 1 or -1,
  // crossings at asin(5/6) + n half turns of 2 (pi - atan(sqrt(.44))); half a half turn after a crossing it is at rest.
  // A step ends 512 eps x 1 or 8 eps t speed beyond the crossing, and the force has the wrong sign for as long: the energy
  // changes by 2 x 1.1e-13 before 10 s, and by 2 x 8 eps x 0.66 t at t = 5.1 n, of which the sum over n < 20 is 2.3e-12. It
  // is the period that does not depend on it; a time late by d moves the mass from its rest by d in speed: 20 x 3e-12.
  const double speed = std::sqrt(0.44), first = std::asin(5.0 / 6),
               half_turn = 2 * (std::numbers::pi - std::atan(speed));
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  EnergyMeter energy(system);
  State<double> state{0.0, Coordinates<double>{{0, 0}, {1, 0}}, Coordinates<double>{{0, 0}, {-1.2, 0}}};
  double soon = 0, late = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    double& worst = view.end() < 10 ? soon : late;
    worst = std::max(worst, std::abs(energy(view.state()).total() / 0.72 - 1));
    return true;
  };
  Lockstep run(taylor(system, 20, std::make_unique<JorbaZou>()));
  const double until = first + 20 * half_turn + half_turn / 2;
  ASSERT_EQ(run.run(state, until, options).outcome, Outcome::success);
  EXPECT_LT(soon, 1e-12);
  EXPECT_LT(late, 2.3e-12 / 0.72 + 1e-12);
  EXPECT_NEAR(std::abs(state.position(1, 0)), 1 + std::sqrt(1.44), 1e-11);
  EXPECT_NEAR(state.velocity(1, 0), 0, 6e-11);
  EXPECT_EQ(state.position(1, 1), 0);
}

TEST_P(Contacts, OfTheEndsOfASpringAreFoundFarFromTheOrigin) {
  // Held at 1000 m, a mass at 999.9 m that flies through the other end, k = L = 1: (|d| - 1)^2 + v^2 stays. Places are rounded
  // to 1e-13 m, and 512 of these may hide the crossing: 2 x 1.1e-10 each time; twice within 4 s, and the tolerance.
  System<double> system(1, {1.0, 1.0});
  system.fix(0);
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  State<double> state{0.0, Coordinates<double>{{1000}, {999.9}}, Coordinates<double>{{0}, {1}}};
  EnergyMeter energy(system);
  const double before = energy(state).total();
  ASSERT_EQ(GetParam().make(system, 1e-10)->run(state, 4.0, {}).outcome, Outcome::success);
  EXPECT_NEAR(energy(state).total(), before, 1e-8);
}

TEST(Contacts, OfARandomDegreeAreFoundToo) {
  // The step is shortened before the degree is drawn, so that the mean over draws is the motion: with tolerances of
  // 1e-4 the energy of 64 bounces stays within 10 x 64 x 1e-4 x 4.4 / (0.01 s) ... of 9.81; without, the mass would fall
  // through.
  const Bounce bounce;
  EnergyMeter energy(bounce.system);
  State<double> state = bounce.start;
  Lockstep run(std::make_unique<RandomTaylor>(bounce.system, geometric(4, 8, 0.5),
                                              std::make_unique<VarianceTarget>(1e-3, 0.1, 1e-7, 1e-7)));
  ASSERT_EQ(run.run(state, 10 * Bounce::period(), {}).outcome, Outcome::success);
  EXPECT_NEAR(energy(state).total() / Bounce::g, 1, 1e-2);
}

}  // namespace
}  // namespace jetlag::testing::contacts_test
