// SPDX-License-Identifier: MIT
// The laws that every integrator obeys. A new member of the family inherits them by the promises of its record.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "integrators/methods.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/problems.hpp"

namespace jetlag::testing {
namespace {

/// Where a run from scene.start ends.
State<double> after(const Problem& scene, std::unique_ptr<Integrator> integrator, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(Lockstep(std::move(integrator)).run(state, until, {}).outcome, Outcome::success);
  return state;
}

class IntegratorLaws : public ::testing::TestWithParam<Promised> {
 protected:
  std::unique_ptr<Integrator> make(const Problem& scene, double step, std::uint64_t seed = 1) const {
    return GetParam().make(scene.system, step, seed);
  }
};

/// Those of the methods that declare it.
class ConvergentIntegratorLaws : public IntegratorLaws {};  // two steps of ratio 4 show their order
class ExactIntegratorLaws : public IntegratorLaws {};       // they do not perturb every motion
class SymmetricIntegratorLaws : public IntegratorLaws {};
class BoundedEnergyIntegratorLaws : public IntegratorLaws {};

template <class F>
std::vector<Promised> methods_where(F which) {
  std::vector<Promised> found;
  for (const Promised& method : all_methods())
    if (which(method)) found.push_back(method);
  return found;
}
std::vector<Promised> methods_that_declare(bool Promise::* property) {
  return methods_where([=](const Promised& method) { return method.*property; });
}

/// Root mean square over seeds of the error of the planet's position and velocity at t = 1.
double error_at_one(const Promised& method, double e, double step) {
  const Problem scene = planet(e);
  const KeplerPoint truth = kepler(e, 1.0);
  const int seeds = method.random ? 1000 : 1;
  double squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const State<double> end = after(scene, method.make(scene.system, step, seed), 1.0);
    squares += (end.position.row(1) - truth.position).squaredNorm() +
               (end.velocity.row(1) - truth.velocity).squaredNorm();
  }
  return std::sqrt(squares / seeds);
}

TEST(Integrators, PromiseSomethingEach) {
  for (const MethodRecord& record : method_records())
    EXPECT_EQ(record.promises.empty(), record.stepper == nullptr)
        << record.name << ": add its promises to its record";
}

TEST_P(ConvergentIntegratorLaws, TheErrorFallsWithTheDeclaredOrder) {
  // Kepler e = .1 up to t = 1, steps 1/16 and 1/64, or as declared. The slope differs from the order by a h / ln 4,
  // a h the next term of the error: 0.02 for most. Each of two samples of 1000 seeds adds sqrt(2/1000) / 2 / ln 4 = 0.02.
  const Promised& method = GetParam();
  const double coarse = error_at_one(method, 0.1, method.coarse_step),
               fine = error_at_one(method, 0.1, method.coarse_step / 4);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), method.order, method.next_term)
      << coarse << " and " << fine << ", seeds 1 .. 1000";
}

TEST_P(ExactIntegratorLaws, MotionsOfItsDegreeAreExact) {
  // Free fall is of degree 2; without a field, of degree 1.
  ASSERT_GE(GetParam().exact_degree, 1);
  Problem scene = free_fall();
  if (GetParam().exact_degree < 2) {
    scene.system = System<double>(3, {2.0});
  }
  const double acceleration[] = {0.5, -0.25, -9.75};
  const double t = 2.5, eps = std::numeric_limits<double>::epsilon();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const State<double> end = after(scene, make(scene, 0.1, seed), t);
    for (int c = 0; c < 3; ++c) {
      const double a = GetParam().exact_degree < 2 ? 0.0 : acceleration[c];
      const double x = scene.start.position(0, c), v = scene.start.velocity(0, c);
      // 25 steps of a few roundings each, of numbers below 35.
      EXPECT_NEAR(end.position(0, c), x + t * (v + t * a / 2), 25 * 4 * 35 * eps) << "seed " << seed;
      EXPECT_NEAR(end.velocity(0, c), v + t * a, 25 * 4 * 35 * eps) << "seed " << seed;
    }
  }
}

TEST_P(SymmetricIntegratorLaws, StepsForthAndBackReturn) {
  const Problem scene = spring_cube(1);
  State<double> state = scene.start;
  const auto integrator = make(scene, 0.25);
  Report report;
  for (int i = 0; i < 20; ++i) {
    integrator->step(state, 1.0, report);
    state.time += 0.25;
  }
  state.velocity = -state.velocity;
  for (int i = 0; i < 20; ++i) {
    integrator->step(state, 1.0, report);
    state.time += 0.25;
  }
  // 40 steps, each with some 10 roundings of numbers below 2, which the motion carries on without growth.
  EXPECT_LT((state.position - scene.start.position).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((state.velocity + scene.start.velocity).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_P(BoundedEnergyIntegratorLaws, TheEnergyErrorDoesNotGrowWithTime) {
  // 500 periods of Kepler e = .3: the largest error of the last 10 periods is that of the first 10.
  const Problem scene = planet(0.3);
  const double period = 2 * std::numbers::pi;
  EnergyMeter energy(scene.system);
  double first = 0, last = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView& view) {
    const double error = std::abs(energy(view.state()).total() + 0.5);
    if (view.end() < 10 * period) first = std::max(first, error);
    if (view.end() > 490 * period) last = std::max(last, error);
    return true;
  };
  State<double> state = scene.start;
  ASSERT_EQ(Lockstep(make(scene, period / 100)).run(state, 500 * period, options).outcome, Outcome::success);
  EXPECT_GT(first, 1e-6);
  // The orbit precesses, so that steps fall on other points of it: some percent.
  EXPECT_NEAR(last, first, 0.1 * first);
}

TEST_P(IntegratorLaws, NoStepIsLongerThanTheLimit) {
  const Problem scene = spring_cube(2);
  const auto integrator = make(scene, 0.1);
  State<double> state = scene.start;
  Report report;
  for (double limit : {1.0, 0.1, 0.05, 1e-3, 1e-9}) {
    const double h = integrator->step(state, limit, report);
    if (GetParam().random_length) {
      EXPECT_LE(h, limit);
    } else {
      EXPECT_EQ(h, std::min(limit, 0.1));
    }
    EXPECT_EQ(report.outcome, Outcome::success);
  }
}

TEST_P(IntegratorLaws, TheTimeOfTheStateIsLeftToTheCaller) {
  Problem scene = spring_cube(2);
  scene.start.time = 3.0;
  State<double> state = scene.start;
  Report report;
  make(scene, 0.1)->step(state, 1.0, report);
  EXPECT_EQ(state.time, 3.0);
}

TEST_P(IntegratorLaws, ThePieceIsTheStep) {
  const Problem scene = spring_cube(3);
  const auto integrator = make(scene, 0.125);
  State<double> state = scene.start;
  Report report;
  for (int i = 0; i < 10; ++i) {
    const State<double> before = state;
    const double h = integrator->step(state, 1.0, report);
    const Piece piece = integrator->piece();
    EXPECT_EQ(piece.begin, before.time);
    EXPECT_EQ(piece.end, before.time + h);
    EXPECT_EQ(piece.at(piece.begin).position, before.position);
    const State<double> end = piece.at(piece.end);
    // Some 10 roundings of numbers below 2.
    EXPECT_LT((end.position - state.position).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((end.velocity - state.velocity).cwiseAbs().maxCoeff(), 1e-14);
    state.time += h;
  }
}

TEST_P(IntegratorLaws, AFailedStepLeavesTheStateAlone) {
  // Springs without length, particles that coincide, a step too small for the time, a state that overflows.
  Problem coincident = falling_together(0.0);
  Problem collapsed = dumbbell(1.0, 1.0, 1.0);
  collapsed.start.position.setZero();
  Problem late = oscillator();
  late.start.time = 1e20;
  const Problem huge = oscillator(1.0, 1e308, 1e308);
  using Case = std::pair<const Problem*, Outcome>;
  for (const auto& [scene, outcome] :
       {Case{&coincident, Outcome::non_finite}, Case{&collapsed, Outcome::non_finite},
        Case{&late, Outcome::step_underflow}, Case{&huge, Outcome::non_finite}}) {
    const auto integrator = make(*scene, 100.0);
    State<double> state = scene->start;
    Report report;
    EXPECT_EQ(integrator->step(state, 1e9, report), 0.0);
    EXPECT_EQ(report.outcome, outcome) << report.message;
    EXPECT_EQ(report.particle, 0);
    EXPECT_NE(report.message.find("particle 0"), std::string::npos) << report.message;
    EXPECT_NE(report.message.find(scene == &late ? "t = 1e+20 " : "t = 0"), std::string::npos)
        << report.message;
    EXPECT_EQ(state.time, scene->start.time);
    EXPECT_EQ(state.position, scene->start.position);
    EXPECT_EQ(state.velocity, scene->start.velocity);
    EXPECT_EQ(integrator->work().steps, 0u);
  }
}

TEST_P(IntegratorLaws, FixedParticlesStayWhereTheyAre) {
  Problem scene = spring_cube(4);
  for (int i : {0, 5}) {
    scene.system.fix(i);
    scene.start.velocity.row(i).setZero();
  }
  const State<double> end = after(scene, make(scene, 0.1), 2.0);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(end.position.row(i) == scene.start.position.row(i), i == 0 || i == 5) << i;
    EXPECT_EQ(end.velocity.row(i).isZero(0.0), i == 0 || i == 5) << i;
  }
}

TEST_P(IntegratorLaws, TheSameSeedGivesTheSameBits) {
  const Problem scene = spring_cube(5);
  const State<double> one = after(scene, make(scene, 0.1, 7), 2.0),
                      two = after(scene, make(scene, 0.1, 7), 2.0);
  const State<double> other = after(scene, make(scene, 0.1, 8), 2.0);
  EXPECT_EQ(one.position, two.position) << "seed 7";
  EXPECT_EQ(one.velocity, two.velocity) << "seed 7";
  EXPECT_EQ(one.position != other.position, GetParam().random) << "seeds 7 and 8";
}

TEST_P(IntegratorLaws, StepsAndUpdatesAreCounted) {
  Problem scene = spring_cube(6);
  scene.system.fix(3);
  scene.start.velocity.row(3).setZero();
  Lockstep lockstep(make(scene, 0.125));
  State<double> state = scene.start;
  ASSERT_EQ(lockstep.run(state, 2.0, {}).outcome, Outcome::success);
  if (!GetParam().random_length) {
    EXPECT_EQ(lockstep.work().steps, 16u);
  }
  EXPECT_EQ(lockstep.work().updates, lockstep.work().steps * 7);
  EXPECT_EQ(lockstep.work().rejected, 0u);
}

const auto name_of = [](const auto& info) { return info.param.name; };

INSTANTIATE_TEST_SUITE_P(, IntegratorLaws, ::testing::ValuesIn(all_methods()), name_of);
INSTANTIATE_TEST_SUITE_P(, ConvergentIntegratorLaws,
                         ::testing::ValuesIn(methods_where([](const Promised& method) {
                           return method.coarse_step != 0;
                         })),
                         name_of);
INSTANTIATE_TEST_SUITE_P(, ExactIntegratorLaws, ::testing::ValuesIn(methods_where([](const Promised& method) {
                           return method.exact_degree >= 0;
                         })),
                         name_of);
INSTANTIATE_TEST_SUITE_P(, SymmetricIntegratorLaws,
                         ::testing::ValuesIn(methods_that_declare(&Promise::symmetric)), name_of);
INSTANTIATE_TEST_SUITE_P(, BoundedEnergyIntegratorLaws,
                         ::testing::ValuesIn(methods_that_declare(&Promise::energy_bounded)), name_of);

}  // namespace
}  // namespace jetlag::testing
