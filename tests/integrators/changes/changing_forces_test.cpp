// SPDX-License-Identifier: MIT
// Forces that make choices: a step ends where one changes, whatever it depends on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "integrators/changes/singular_laws.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing::changing_forces_test {
namespace {

using singular_laws::QuadraticDrag;

/// Pulls where |x| > 1:  F = -k (|x| - 1) x / |x|.
struct Rope {
  static constexpr const char* name = "rope";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& k) {
    const T length = p.position[0].norm();
    return T(select(length > 1.0, T(-k * (length - 1.0) / length), T(0.0))) * p.position[0];
  }
};

/// 1 N along x for 1 <= t < 2.
struct Push {
  static constexpr const char* name = "push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = select(p.time >= 1.0 && p.time < 2.0, T(1.0), T(0.0));
    return f;
  }
};

/// F = -sign(v): dry friction.
struct Friction {
  static constexpr const char* name = "friction";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f;
    for (int c = 0; c < D; ++c) f[c] = select(p.velocity[0][c] > 0.0, T(-1.0), T(1.0));
    return f;
  }
};

/// F = -v / |v|.
struct DryFriction {
  static constexpr const char* name = "dry_friction";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    return T(T(-1.0) / p.velocity[0].norm()) * p.velocity[0];
  }
};

/// F = k (max(1 - x, 0) / 2)^(3/2): an elastic ball of radius 1 m against a wall at x = 0, which it does not touch at first.
struct HertzContact {
  static constexpr const char* name = "hertz_contact";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& k) {
    using std::max, std::pow;
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = k * pow(T(max(T(1.0 - p.position[0][0]), T(0.0)) / 2.0), 1.5);
    return f;
  }
};

/// F = 1 N along x where 1 / (1 + 25 (t - 5)^2) > 1/2: for |t - 5| < 1/5.
struct Bump {
  static constexpr const char* name = "bump";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    const T s = p.time - 5.0;
    f[0] = select(T(1.0) / (1.0 + 25.0 * s * s) > 0.5, T(1.0), T(0.0));
    return f;
  }
};

State<> at(std::initializer_list<double> x, std::initializer_list<double> v) {
  const auto row = [](std::initializer_list<double> values) {
    Coordinates<> c(1, values.size());
    std::copy(values.begin(), values.end(), c.data());
    return c;
  };
  return {0.0, row(x), row(v)};
}

struct Way {
  const char* name;
  std::function<Report(const System<>&, State<>&, double until)> run;
  bool steps_are_given = false;
  double error = 1e-12;  // some hundred steps, each right to rounding
};

/// Some hundred steps with a tolerance of 1e-12 m, each of which may end that far beyond a change: a force of 100 N/kg turns
/// that into less than 1e-9 m.
constexpr double of_clocks = 1e-9;
ClockOptions tight() {
  ClockOptions options;
  options.tolerance = 1e-12;
  return options;
}

/// A motion that comes to rest within a tolerance of a jump goes on there in steps of 1e-8 s.
RunOptions not_for_ever() {
  RunOptions options;
  options.max_steps = 20'000;
  return options;
}

/// Lockstep with steps of a control and with steps of one length, Taylor's method of any number type, and clocks.
std::vector<Way> ways() {
  const auto lockstep = [](std::function<std::unique_ptr<Control>()> control) {
    return [control](const System<>& system, State<>& state, double until) {
      return Lockstep(taylor(system, 20, control())).run(state, until, RunOptions{});
    };
  };
  return {{"jorba_zou", lockstep([] { return std::make_unique<JorbaZou>(); })},
          {"fixed steps", lockstep([] { return std::make_unique<FixedStep>(0.031); }), true},
          {"one clock", [](const System<>& system, State<>& state,
                           double until) { return ParticleTaylor<>(system).run(state, until); }},
          {"free clocks",
           [](const System<>& system, State<>& state, double until) {
             return Asynchronous(system, fixed_degree(16), {tight()}).run(state, until, not_for_ever());
           },
           false, of_clocks},
          {"blocks",
           [](const System<>& system, State<>& state, double until) {
             return BlockSteps(system, fixed_degree(16), {tight()}).run(state, until, not_for_ever());
           },
           false, of_clocks}};
}

TEST(ChangingForce, HertzContactReturnsTheBallAndIsNotFeltInFlight) {
  // With d'^2 = v^2 - (4/5) (k/m) d^(5/2) / 2^(3/2) it goes in to D, where that is zero, and takes
  // (2 D / v) integral_0^1 du / sqrt(1 - u^(5/2)) = (4/5) B(2/5, 1/2) D / v to come back with the speed it had.
  const double stiffness = 1000, speed = 2;
  const double depth = std::pow(1.25 * speed * speed * std::pow(2.0, 1.5) / stiffness, 0.4);
  const double contact = 0.8 * boost::math::beta(0.4, 0.5) * depth / speed;
  System<> system(1, {1.0});
  system.add<HertzContact>({{0}}, {{stiffness}});
  for (const Way& way : ways()) {
    State<> state = at({1.9}, {-speed});
    const Report report = way.run(system, state, 2.0);
    // Where it begins to touch, little of the series of the power is left: given steps may be too long there, and say so.
    if (way.steps_are_given && report.outcome == Outcome::step_underflow) continue;
    ASSERT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    // Nine given steps of .031 s lie in the contact. Clocks allow each step 1e-12 m, which beside the singular ends of the contact
    // is up to 1e-12 m / 1e-5 s of the speed.
    const double error = way.steps_are_given ? 1e-9 : way.error == of_clocks ? 1e-6 : 1e-12;
    EXPECT_NEAR(state.velocity(0, 0), speed, error) << way.name;
    EXPECT_NEAR(state.position(0, 0), 1 + speed * (2.0 - 0.45 - contact), error) << way.name;
  }
}

TEST(ChangingForce, DragTurnsRoundWithTheMotion) {  // atan on the way up, tanh on the way down
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  for (const Way& way : ways()) {
    State<> state = at({0, 0}, {0, 10});
    const Report report = way.run(system, state, 2);
    // Beside v = 0 rounding leaves little of the series of |v|: steps that are given are too long there, and say so.
    if (way.steps_are_given && report.outcome == Outcome::non_finite) continue;
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 1), -2.33261407566854, 10 * way.error) << way.name;
    EXPECT_NEAR(state.velocity(0, 1), -8.2206226286468, 10 * way.error) << way.name;
  }
}

TEST(ChangingForce, DragStartsFromRest) {  // where |v| has a kink: y = -v^2/g ln cosh(g t/v), v^2 = 98
  const double g = 9.8, v = std::sqrt(98.0), fallen = -v * v / g * std::log(std::cosh(2 * g / v));
  EXPECT_NEAR(fallen, -13.0563927612838, 1e-13);
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -g, 0.0}});
  for (const Way& way : ways()) {
    State<> state = at({0, 0}, {0, 0});
    const Report report = way.run(system, state, 2);
    if (way.error == of_clocks && report.outcome == Outcome::non_finite) {  // and it is said
      EXPECT_NE(report.message.find("a norm or root of what is zero?"), std::string::npos) << report.message;
      continue;
    }
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 1), fallen, 10 * way.error) << way.name;
    EXPECT_NEAR(state.velocity(0, 1), -v * std::tanh(2 * g / v), 10 * way.error) << way.name;
  }
}

TEST(ChangingForce, ARopePullsWhenItIsTight) {  // a line, half a period of 10 rad/s, the line back
  System<> system(1, {1.0});
  system.add<Rope>({{0}}, {{100.0}});
  for (const Way& way : ways()) {
    State<> state = at({0.5}, {1});
    const Report report = way.run(system, state, 1);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 0), 0.5 + M_PI / 10, way.error) << way.name;
    EXPECT_NEAR(state.velocity(0, 0), -1, way.error) << way.name;
  }
}

TEST(ChangingForce, OfTimeIsMetOnTime) {
  System<> system(2, {1.0});
  system.add<Push>({{0}}, {std::array<double, 0>{}});
  for (const Way& way : ways()) {
    State<> state = at({0, 0}, {0, 1});
    EXPECT_EQ(way.run(system, state, 17).outcome, Outcome::success) << way.name;
    EXPECT_NEAR(state.position(0, 0), 0.5 + 15, 20 * way.error) << way.name;
    EXPECT_NEAR(state.velocity(0, 0), 1, way.error) << way.name;
  }
}

TEST(ChangingForce, IsMetWhereItsConditionHasNoSeriesFromFarOff) {
  System<> system(2, {1.0});
  system.add<Bump>({{0}}, {std::array<double, 0>{}});
  for (const Way& way : ways()) {
    State<> state = at({0, 0}, {0, 0});
    EXPECT_EQ(way.run(system, state, 17).outcome, Outcome::success) << way.name;
    EXPECT_NEAR(state.velocity(0, 0), 0.4, way.error) << way.name;
    EXPECT_NEAR(state.position(0, 0), 0.4 * 12, 10 * way.error) << way.name;
  }
}

TEST(ChangingForce, OfUnitLengthIsNotFollowedThroughItsJump) {
  System<> system(2, {1.0});
  system.add<DryFriction>({{0}}, {std::array<double, 0>{}});
  for (const Way& way : ways()) {
    State<> state = at({0, 0}, {1, 0});
    const Report report = way.run(system, state, 3);
    EXPECT_NE(report.outcome, Outcome::success)
        << way.name << ": " << state.position << ", " << state.velocity;
    EXPECT_NEAR(state.time, 1, 0.04) << way.name;
  }
}

TEST(ChangingForce, ParticlesFindTheirWayBack) {
  System<> system(1, {1.0});
  system.add<Rope>({{0}}, {{100.0}});
  ParticleTaylor<> method(system);
  State<> state = at({0.5}, {1});
  ASSERT_EQ(method.run(state, 0.6).outcome, Outcome::success);
  ASSERT_EQ(method.run(state, 0).outcome, Outcome::success);
  EXPECT_NEAR(state.position(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(state.velocity(0, 0), 1, 1e-10);
}

TEST(ChangingForce, FrictionThatStopsAMotionIsAnOutcome) {
  System<> system(1, {1.0});
  system.add<Friction>({{0}}, {std::array<double, 0>{}});
  for (const Way& way : ways()) {
    State<> state = at({0}, {1});
    const Report report = way.run(system, state, 3);
    EXPECT_EQ(report.outcome, Outcome::step_underflow) << way.name;
    EXPECT_NE(report.message.find("slides"), std::string::npos) << report.message;
    EXPECT_NEAR(state.time, 1, 1e-6) << way.name;
    EXPECT_NEAR(state.position(0, 0), 0.5, 1e-6) << way.name;
  }
}

TEST(ChangingForce, StepsThatLeadNowhereEndTheRun) {
  // A particle at 1e19 m: its angle and its dihedral angle are known for 3e-20 s at a time, and 0.005 s would take 1e17 of
  // these steps, each right.
  System<> system(3, {1.0, 1.0, 1.0, 1.0});
  system.add<Angle>({{0, 1, 2}}, {{1.0, std::cos(1.0)}});
  system.add<Dihedral<2>>({{0, 1, 2, 3}}, {{1.0, 0.2}});
  system.add<Drag>({{0}, {1}, {2}, {3}}, {{0.1}, {0.1}, {0.1}, {0.1}});
  State<> state{0.0, Coordinates<double>(4, 3), Coordinates<double>::Zero(4, 3)};
  state.position << 0, 12345678901234567890.0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0.5;
  RunOptions options;
  options.max_steps = 10'010;
  const Report report =
      Lockstep(taylor(system, 6, std::make_unique<FixedStep>(1e-3))).run(state, 0.005, options);
  EXPECT_EQ(report.outcome, Outcome::step_underflow) << report.message;
  EXPECT_GT(state.time, 1e-16);
  EXPECT_LT(state.time, 1e-14);
}

TEST(ChangingForce, OnlyStepsThatLeadToNoChangeLeadNowhere) {
  StepsToChanges<double> nowhere, far_enough, to_changes;
  double time = 0;
  int first_stuck = -1;
  for (int n = 0; n < 20'000; ++n) {
    time += nowhere.step(1.0, 0x1p-41, time, std::nullopt);
    far_enough.step(1.0, 0x1p-39, time, std::nullopt);
    to_changes.step(1.0, 1.0, time, 0x1p-41);
    if (nowhere.is_stuck() && first_stuck < 0) first_stuck = n;
  }
  EXPECT_EQ(first_stuck, 9'999);
  EXPECT_FALSE(far_enough.is_stuck());
  EXPECT_FALSE(to_changes.is_stuck());
  nowhere.step(1.0, 1.0, time, 0.5);  // a step that leads on
  EXPECT_FALSE(nowhere.is_stuck());
}

TEST(ChangingForce, WithoutChoicesNothingIsWatched) {
  System<> system(2, {1.0, 1.0});
  system.add<Gravity>({{0, 1}}, {{1.0}});
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  system.add<Floor>({{0}}, {{1.0, 0.0, 0.0, 1.0, 0.0}});
  EXPECT_FALSE(Expansion<>(system).has_conditions());  // their kinks and poles are known otherwise
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  EXPECT_TRUE(Expansion<>(system).has_conditions());
}

}  // namespace
}  // namespace jetlag::testing::changing_forces_test
