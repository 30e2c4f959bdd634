// SPDX-License-Identifier: MIT
// Motions that begin where a force has no series: a norm or root of what is zero there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "integrators/changes/singular_laws.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"

namespace jetlag::testing::singular_starts_test {
namespace {

using namespace singular_laws;

struct Way {
  const char* name;
  std::function<std::unique_ptr<Control>()> control;
  double error;  // of each step [m], or what some hundred roundings of a motion of 10 m leave
};

std::vector<Way> ways() {
  return {{"jorba_zou", [] { return std::make_unique<JorbaZou>(); }, 1e-12},
          {"last_two", [] { return std::make_unique<LastTwo>(1e-12); }, 1e-11},
          {"fixed steps", [] { return std::make_unique<FixedStep>(0.031); }, 1e-12}};
}

Report run(const Way& way, const System<>& system, State<>& state, double until,
           RandomTaylor::Options options = {}) {
  return Lockstep(std::make_unique<RandomTaylor>(system, fixed_degree(20), way.control(), options))
      .run(state, until, RunOptions{});
}

TEST(SingularStart, FallsFromRestAgainstDragInAnyDirection) {
  const double c = 0.1;
  for (const Way& way : ways())
    for (const std::array<double, 3> g :
         {std::array{9.8, 0.0, 0.0}, std::array{-3.0, 4.0, 0.0}, std::array{1.0, -2.0, 2.0}})
      for (const int dimension : {1, 2, 3}) {
        const double size = dimension == 1   ? std::abs(g[0])
                            : dimension == 2 ? std::hypot(g[0], g[1])
                                             : std::hypot(g[0], g[1], g[2]);
        System<> system(dimension, {1.0});
        system.add<QuadraticDrag>({{0}}, {{c}});
        system.add<UniformField>({{0}}, {{g[0], g[1], g[2]}});
        State<> state = at_rest(1, dimension);
        const Report report = run(way, system, state, 2);
        EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
        for (int i = 0; i < dimension; ++i) {
          EXPECT_NEAR(state.position(0, i), g[i] / size * fallen(size, c, 2), 10 * way.error) << way.name;
          EXPECT_NEAR(state.velocity(0, i), g[i] / size * falling(size, c, 2), 10 * way.error) << way.name;
        }
      }
}

TEST(SingularStart, TakesAStepAsLongAsForcesAllow) {
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  RandomTaylor method(system, fixed_degree(20), std::make_unique<JorbaZou>());
  State<> state = at_rest(1, 2);
  Report report;
  const double first = method.step(state, 2, report);
  ASSERT_EQ(report.outcome, Outcome::success) << report.message;
  // |v| v / 10 = 9.6 h^2 is off by no more than 8 eps of some 10 m/s in h:   h^3 = 16 eps, but for the halving of h.
  EXPECT_LT(first, 3e-5);
  EXPECT_GT(first, 1e-6);
}

TEST(SingularStart, LeavesTheSingularPointInStepsThatGrow) {
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  RandomTaylor method(system, fixed_degree(20), std::make_unique<JorbaZou>());
  State<> state = at_rest(1, 2);
  Report report;
  int steps = 0;
  for (; state.time < 2 && report.outcome == Outcome::success && steps < 1000; ++steps)
    state.time += method.step(state, 2 - state.time, report);
  // The series of |v| goes on as if there were no kink, but rounding looks like a singularity at a distance of
  // some h eps^(-1/20) = 6 h after a time h, of which a step takes 1/8: from 1e-5 s to 1 s there are 5 ln 10 / ln 1.8 = 20.
  EXPECT_EQ(report.outcome, Outcome::success) << report.message;
  EXPECT_LT(steps, 60);
}

TEST(SingularStart, KeepsTheMotionOfTheShortStep) {
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  RandomTaylor method(system, fixed_degree(20), std::make_unique<JorbaZou>());
  State<> state = at_rest(1, 2);
  Report report;
  const double h = method.step(state, 2, report);
  ASSERT_EQ(report.outcome, Outcome::success) << report.message;
  const Piece piece = method.piece();
  EXPECT_EQ(piece.at(h).position, state.position);
  EXPECT_NEAR(piece.at(h / 2).position(0, 1), -9.8 * h * h / 8, 1e-15 * h * h);
  EXPECT_NEAR(piece.at(h / 2).velocity(0, 1), -9.8 * h / 2, 1e-15 * h);
}

TEST(SingularStart, KeepsRestsOfCompensatedSums) {
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  RandomTaylor::Options options;
  options.compensated = true;
  State<> state = at_rest(1, 2);
  state.position(0, 1) = 1e6;
  ASSERT_EQ(run(ways()[0], system, state, 2, options).outcome, Outcome::success);
  EXPECT_NEAR((state.position(0, 1) - 1e6) + state.position_rest(0, 1), -fallen(9.8, 0.1, 2), 1e-12);
}

TEST(SingularStart, RestStaysRest) {
  for (const Way& way : ways())
    for (const int dimension : {1, 2, 3}) {
      System<> system(dimension, {1.0});
      system.add<QuadraticDrag>({{0}}, {{0.1}});
      State<> state = at_rest(1, dimension);
      const Report report = run(way, system, state, 2);
      EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
      EXPECT_TRUE(state.position.isZero(0.0) && state.velocity.isZero(0.0)) << way.name;
    }
}

TEST(SingularStart, OneRestsWhileAnotherMoves) {  // x'' = -c x'^2 from v:   x = ln(1 + c v t) / c
  for (const Way& way : ways()) {
    System<> system(2, {1.0, 1.0});
    system.add<QuadraticDrag>({{0}, {1}}, {{0.1}, {0.2}});
    State<> state = at_rest(2, 2);
    state.velocity(1, 0) = 3;
    const Report report = run(way, system, state, 4);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_TRUE(state.position.row(0).isZero(0.0)) << way.name;
    EXPECT_NEAR(state.position(1, 0), std::log(1 + 0.2 * 3 * 4) / 0.2, 10 * way.error) << way.name;
  }
}

TEST(SingularStart, FallsFromRestBesideAnotherThatSwings) {
  for (const Way& way : ways()) {
    System<> system(2, {1.0, 1.0, 1.0});
    system.add<QuadraticDrag>({{0}}, {{0.1}});
    system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
    system.add<ZeroLengthSpring>({{1, 2}}, {{4.0}});
    system.fix(2);
    State<> state = at_rest(3, 2);
    state.position(1, 0) = 1;
    const Report report = run(way, system, state, 2);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 1), -fallen(9.8, 0.1, 2), 10 * way.error) << way.name;
    EXPECT_NEAR(state.position(1, 0), std::cos(4.0), 10 * way.error) << way.name;
  }
}

TEST(SingularStart, HalfDiscOfForceFromItsEdge) {  // v(1/2) = pi/16, x(1/2) = 1/24
  System<> system(1, {1.0});
  system.add<HalfDisc>({{0}}, {none});
  for (const Way& way : ways()) {
    if (way.control()->is_given())
      continue;  // no step of one length follows a root from beside its branch point
    State<> state = at_rest(1, 1);
    const Report report = run(way, system, state, 0.5);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.velocity(0, 0), M_PI / 16, 10 * way.error) << way.name;
    EXPECT_NEAR(state.position(0, 0), 1.0 / 24, 10 * way.error) << way.name;
  }
}

TEST(SingularStart,
     AForceThatComesBackToZeroIsNotOverlooked) {  // at t = 1 as at t = 0; v(1) = pi/8, x(1) = pi/16
  System<> system(1, {1.0});
  system.add<HalfDisc>({{0}}, {none});
  for (const Way& way : ways()) {
    State<> state = at_rest(1, 1);
    const Report report = run(way, system, state, 1);
    EXPECT_GT(state.time, way.control()->is_given() ? 0 : 0.5) << way.name << ": " << report.message;
    if (report.outcome != Outcome::success) continue;  // the other end is singular too
    EXPECT_NEAR(state.velocity(0, 0), M_PI / 8, 1e-6) << way.name;
    EXPECT_NEAR(state.position(0, 0), M_PI / 16, 1e-6) << way.name;
  }
}

TEST(SingularStart, PushesThatGrowFromRestAtLateTimes) {  // x = s^2/2 + s^3/6
  for (const Way& way : ways())
    for (const double start : {0.0, 1.0, 100.0}) {
      System<> system(1, {1.0});
      system.add<GrowingPush>({{0}}, {{start}});
      State<> state = at_rest(1, 1);
      state.time = start;
      const Report report = run(way, system, state, start + 1);
      EXPECT_EQ(report.outcome, Outcome::success) << way.name << " from " << start << ": " << report.message;
      // Times are rounded to eps start.
      EXPECT_NEAR(state.position(0, 0), 1.0 / 2 + 1.0 / 6, 10 * way.error + 3e-15 * start) << way.name;
    }
}

TEST(SingularStart, RestThatMayEndAtAnyTimeIsRefused) {
  System<> system(1, {1.0});
  system.add<Cone>({{0}}, {none});
  for (const Way& way : ways()) {
    State<> state = at_rest(1, 1);
    const Report report = run(way, system, state, 2);
    EXPECT_EQ(report.outcome, Outcome::non_finite) << way.name << ": " << state.position;
    EXPECT_EQ(state.time, 0) << way.name;
  }
}

TEST(SingularStart, OfParticlesThatMoveTogetherSaysWhy) {  // both fall, and u = 0 for ever
  System<> system(2, {1.0, 1.0});
  system.add<RelativeDrag>({{0, 1}}, {none});
  system.add<UniformField>({{0}, {1}}, {{0.0, -9.8, 0.0}, {0.0, -9.8, 0.0}});
  for (const Way& way : ways()) {
    State<> state = at_rest(2, 2);
    const Report report = run(way, system, state, 2);
    EXPECT_EQ(report.outcome, Outcome::non_finite) << way.name;
    EXPECT_NE(report.message.find("a norm or root of what is zero?"), std::string::npos) << report.message;
    EXPECT_TRUE(state.position.isZero(0.0)) << way.name;
  }
}

TEST(SingularStart, ComesToAFixedParticle) {  // u = v_0, and the fixed one feels it too
  for (const Way& way : ways()) {
    System<> system(2, {1.0, 1.0});
    system.add<RelativeDrag>({{0, 1}}, {none});
    system.fix(1);
    State<> state = at_rest(2, 2);
    const Report rest = run(way, system, state, 2);
    EXPECT_EQ(rest.outcome, Outcome::success) << way.name << ": " << rest.message;
    EXPECT_TRUE(state.position.isZero(0.0)) << way.name;
    system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
    state = at_rest(2, 2);
    const Report report = run(way, system, state, 1);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 1), -fallen(9.8, 1, 1), 10 * way.error) << way.name;
  }
}

TEST(SingularStart, RestEndsWhereAPushBegins) {  // ln cosh 1 up to 2 s, and then x = x(2) + ln(1 + v(2) t)
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{1.0}});
  system.add<Push>({{0}}, {none});
  for (const Way& way : ways()) {
    State<> state = at_rest(1, 2);
    const Report report = run(way, system, state, 4);
    EXPECT_EQ(report.outcome, Outcome::success) << way.name << ": " << report.message;
    EXPECT_NEAR(state.position(0, 0), fallen(1, 1, 1) + std::log1p(2 * std::tanh(1.0)), 10 * way.error)
        << way.name;
  }
}

TEST(SingularStart, StepsThatAreGivenToARandomDegreeSayWhy) {
  System<> system(2, {1.0});
  system.add<QuadraticDrag>({{0}}, {{0.1}});
  system.add<UniformField>({{0}}, {{0.0, -9.8, 0.0}});
  Lockstep method(
      std::make_unique<RandomTaylor>(system, geometric(3, 20, 0.5), std::make_unique<FixedStep>(0.01)));
  State<> state = at_rest(1, 2);
  const Report report = method.run(state, 2, RunOptions{});
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_NE(report.message.find("a norm or root of what is zero?"), std::string::npos) << report.message;
}

// ---- how far it is asked to go -----------------------------------------------------------------------------

/// F = t^(3/2) along x: v = 2/5 t^(5/2).
struct LatePush {
  static constexpr const char* name = "late_push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = p.time * sqrt(p.time);
    return f;
  }
};

TEST(SingularStart, DoesNotDependOnHowFarItIsToGo) {
  System<> pushed(1, {1.0}), fallen_system(1, {1.0});
  pushed.add<LatePush>({{0}}, {std::array<double, 0>{}});
  fallen_system.add<QuadraticDrag>({{0}}, {{1.0}});
  fallen_system.add<UniformField>({{0}}, {{10.0, 0.0, 0.0}});
  for (const double limit : {1.0, 1e4, 1e8}) {
    State<> late = at_rest(1, 1), falls = at_rest(1, 1);
    const auto first_step = [&](const System<>& system, State<>& state) {
      RandomTaylor method(system, fixed_degree(20), std::make_unique<JorbaZou>());
      Report report;
      const double h = method.step(state, limit, report);
      EXPECT_EQ(report.outcome, Outcome::success) << report.message;
      return h;
    };
    const double h = first_step(fallen_system, falls);
    // 8 eps of the terminal speed, sqrt 10, and some roundings of it
    EXPECT_NEAR(falls.velocity(0, 0), falling(10, 1, h), 20 * 2.2e-16 * std::sqrt(10.0)) << limit;
    // Of a push that is not there yet, h |a| = h^(5/2) up to 2^-72 of what it is at the limit is missed.
    EXPECT_LT(first_step(pushed, late), 0x1p-28 * limit);
  }
}

/// exp(-50000 (t - 5.7)^2): v = sqrt(pi / 50000).
struct Pulse {
  static constexpr const char* name = "pulse_of_force";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    const T s = p.time - 5.7;
    f[0] = exp(-50000.0 * s * s);
    return f;
  }
};

TEST(SingularStart, TakesNoStepLongerThanTheControlAllows) {
  System<> system(1, {1.0, 1.0});
  system.add<Pulse>({{0}}, {std::array<double, 0>{}});
  system.add<QuadraticDrag>({{1}}, {{1.0}});  // rests, without a series
  State<> state = at_rest(2, 1);
  state.velocity(0, 0) = 1;
  Lockstep schedule(
      std::make_unique<RandomTaylor>(system, fixed_degree(20), std::make_unique<JorbaZou>(1e-3)));
  ASSERT_EQ(schedule.run(state, 6, RunOptions{}).outcome, Outcome::success);
  EXPECT_GE(schedule.work().steps, 6000u);
  EXPECT_NEAR(state.velocity(0, 0), 1 + std::sqrt(M_PI / 50000), 1e-12);
}

TEST(SingularStart, OfOneDoesNotKeepAnotherSliding) {
  System<> system(1, {1.0, 1.0});
  system.add<ToALine>({{0}}, {std::array<double, 0>{}});
  system.add<QuadraticDrag>({{1}}, {{1.0}});
  State<> state = at_rest(2, 1);
  state.position(0, 0) = 0.5;
  Lockstep schedule(std::make_unique<RandomTaylor>(system, fixed_degree(20), std::make_unique<JorbaZou>()));
  RunOptions options;
  options.max_steps = 2000;
  EXPECT_EQ(schedule.run(state, 5, options).outcome, Outcome::step_underflow);
}

}  // namespace
}  // namespace jetlag::testing::singular_starts_test
