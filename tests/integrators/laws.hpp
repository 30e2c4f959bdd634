// SPDX-License-Identifier: MIT
#pragma once
// The laws of integrators. A new member of the family adds one line to `methods` and inherits them all.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/gauss_radau.hpp"
#include "jetlag/integrators/explicit/hermite.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "jetlag/integrators/explicit/symplectic_euler.hpp"
#include "jetlag/integrators/implicit/explicit_implicit.hpp"
#include "jetlag/integrators/implicit/implicit.hpp"
#include "jetlag/integrators/implicit/implicit_subcycling.hpp"
#include "jetlag/integrators/perturbed/conrad.hpp"
#include "jetlag/integrators/perturbed/exponential_step.hpp"
#include "jetlag/integrators/perturbed/random_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/scenes_for_tests.hpp"

namespace jetlag::testing {

/// A method as it declares itself.
struct Method {
  std::string name;
  double order;                 // global; in mean square where it is random
  int exact_degree;             // solves motions of this degree in time exactly; -1: none, it is perturbed
  bool random = false;          // draws: laws about errors take the root mean square over seeds
  bool symmetric = false;       // a step, and a step with reversed velocities, return
  bool energy_bounded = false;  // over many periods
  bool random_length = false;   // the step is a mean
  double coarse_step =
      1.0 / 16;            // of the two that measure the order, the other is a quarter; 0: a test of its own
  double next_term = 0.1;  // what the next term of the error adds to the order at that step, at most
  std::function<std::unique_ptr<Integrator>(const System<double>& system, double step, std::uint64_t seed)>
      make;
};
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

inline Method taylor_method(int degree) {
  return {.name = "taylor_" + std::to_string(degree),
          .order = static_cast<double>(degree),
          .exact_degree = degree,
          .make = [degree](const System<double>& system, double step, std::uint64_t) {
            return taylor(system, degree, std::make_unique<FixedStep>(step));
          }};
}

/// Degree 5 in compensated sums.
inline Method compensated_taylor() {
  return {.name = "taylor_5_compensated",
          .order = 5,
          .exact_degree = 5,
          .make = [](const System<double>& system, double step, std::uint64_t) {
            RandomTaylor::Options options;
            options.compensated = true;
            return std::make_unique<RandomTaylor>(system, fixed_degree(5), std::make_unique<FixedStep>(step),
                                                  options);
          }};
}

inline Method random_taylor_method(int min_degree, int max_degree, bool shared_draw,
                                   VelocitySeries velocity) {
  const bool derivative = velocity == VelocitySeries::derivative;
  return {.name = "random_taylor_" + std::to_string(min_degree) + "_" + std::to_string(max_degree) +
                  (shared_draw ? "_shared" : "_each") + (derivative ? "_derivative" : "_own_series"),
          // With `derivative`, velocities are one order worse, and the positions after them.
          .order = std::min<double>(max_degree, min_degree + 0.5) - (derivative ? 1 : 0),
          .exact_degree = min_degree,
          .random = true,
          .make = [=](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<RandomTaylor>(system, geometric(min_degree, max_degree, 0.5),
                                                  std::make_unique<FixedStep>(step),
                                                  RandomTaylor::Options{seed, shared_draw, velocity});
          }};
}

inline Method runge_kutta_method(const RungeKuttaTable& table, double coarse_step = 1.0 / 16,
                                 double next_term = 0.1) {
  return {.name = table.name,
          .order = static_cast<double>(table.order),
          .exact_degree = table.order,
          .coarse_step = coarse_step,
          .next_term = next_term,
          .make = [&table](const System<double>& system, double step, std::uint64_t) {
            return std::make_unique<RungeKutta>(system, table, step);
          }};
}

inline Method hermite_method(int iterations) {
  return {.name = "hermite_" + std::to_string(iterations),
          .order = 4,
          .exact_degree = 3,
          .symmetric = iterations > 4,  // to rounding where the corrector has come to rest
          .make = [=](const System<double>& system, double step, std::uint64_t) {
            return std::make_unique<Hermite>(system,
                                             Hermite::Options{.iterations = iterations, .step = step});
          }};
}

inline std::unique_ptr<Integrator> leapfrog_of_any_length(const System<double>& system) {
  return std::make_unique<Leapfrog>(system, 1e300);
}

/// Noise of order p on leapfrog, of order 2.
inline Method conrad_method(double p) {
  return {.name = p < 2 ? "conrad_below" : "conrad_at_order",
          .order = std::min(p, 2.0),
          .exact_degree = -1,
          .random = true,
          .make = [p](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<Conrad>(
                system, leapfrog_of_any_length(system),
                Conrad::Options{.step = step, .order = p, .sigma = 0.1, .seed = seed});
          }};
}

inline Method random_step_method(double p, StepDistribution distribution) {
  return {.name = std::string("random_step_") + (p < 2 ? "below_" : "at_order_") +
                  names_of_step_distributions[static_cast<int>(distribution)],
          .order = std::min(p, 2.0),
          .exact_degree = -1,
          .random = true,
          .make = [=](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<RandomStep>(
                leapfrog_of_any_length(system),
                RandomStep::Options{.step = step, .order = p, .distribution = distribution, .seed = seed});
          }};
}

inline const std::vector<Method> methods = {
    {.name = "symplectic_euler",
     .order = 1,
     .exact_degree = 1,
     .energy_bounded = true,
     .make = [](const System<double>& system, double step,
                std::uint64_t) { return std::make_unique<SymplecticEuler>(system, step); }},
    runge_kutta_method(euler()),
    runge_kutta_method(rk4()),
    runge_kutta_method(dopri5(), 1.0 / 32, 0.2),  // 0.15 here, 0.29 at 1/16: its first term is small
    runge_kutta_method(dop853(), 1.0 / 4),        // shorter steps are accurate to rounding
    {.name = "leapfrog",
     .order = 2,
     .exact_degree = 2,
     .symmetric = true,
     .energy_bounded = true,
     .make = [](const System<double>& system, double step,
                std::uint64_t) { return std::make_unique<Leapfrog>(system, step); }},
    {.name = "gauss_radau",
     .order = 15,
     .exact_degree = 9,
     .coarse_step = 0,
     .make =
         [](const System<double>& system, double step, std::uint64_t) {
           return std::make_unique<GaussRadau>(system, GaussRadau::Options{.step = step});
         }},
    hermite_method(1),
    hermite_method(20),
    conrad_method(1.5),
    conrad_method(2),
    random_step_method(1.5, StepDistribution::lognormal),
    random_step_method(2, StepDistribution::lognormal),
    {.name = "exponential_step",
     .order = 1,
     .exact_degree = 1,
     .random = true,
     .random_length = true,
     .coarse_step = 1.0 / 64,
     .make = [](const System<double>& system, double step,
                std::uint64_t seed) { return std::make_unique<ExponentialStep>(system, step, seed); }},
    {.name = "implicit_midpoint",
     .order = 2,
     .exact_degree = 2,
     .symmetric = true,
     .energy_bounded = true,
     .make = [](const System<double>& system, double step,
                std::uint64_t) { return std::make_unique<ImplicitMidpoint>(system, step); }},
    {.name = "newmark",
     .order = 2,
     .exact_degree = 2,
     .symmetric = true,
     .energy_bounded = true,
     .make = [](const System<double>& system, double step,
                std::uint64_t) { return std::make_unique<Newmark>(system, step); }},
    {.name = "explicit_implicit",  // every second particle is implicit
     .order = 2,
     .exact_degree = 2,
     .symmetric = true,
     .energy_bounded = true,
     .make =
         [](const System<double>& system, double step, std::uint64_t) {
           std::vector<bool> implicit(system.particles());
           for (int i = 1; i < system.particles(); i += 2) implicit[i] = true;
           return std::make_unique<ExplicitImplicit>(system, step, implicit);
         }},
    {.name = "implicit_subcycling",  // a step is a cycle of two; every second particle is coarse
     .order = 2,
     .exact_degree = 2,
     .symmetric = true,
     .energy_bounded = true,
     .make =
         [](const System<double>& system, double step, std::uint64_t) {
           ImplicitSubcycling::Options options{.step = step / 2, .ratio = 2, .coarse = {}};
           for (int i = 1; i < system.particles(); i += 2) options.coarse.push_back(i);
           return std::make_unique<ImplicitSubcycling>(system, options);
         }},
    taylor_method(2),
    taylor_method(3),
    taylor_method(4),
    taylor_method(5),
    taylor_method(6),
    compensated_taylor(),
    random_taylor_method(1, 4, true, VelocitySeries::own_series),
    random_taylor_method(2, 4, true, VelocitySeries::own_series),
    random_taylor_method(3, 6, true, VelocitySeries::own_series),
    random_taylor_method(3, 6, false, VelocitySeries::own_series),
    random_taylor_method(3, 6, true, VelocitySeries::derivative),
    random_taylor_method(3, 6, false, VelocitySeries::derivative),
};

/// Where a run from scene.start ends.
inline State<double> after(const Scene& scene, std::unique_ptr<Integrator> integrator, double until) {
  State<double> state = scene.start;
  EXPECT_EQ(Lockstep(std::move(integrator)).run(state, until, {}).outcome, Outcome::success);
  return state;
}

class IntegratorLaws : public ::testing::TestWithParam<Method> {
 protected:
  std::unique_ptr<Integrator> make(const Scene& scene, double step, std::uint64_t seed = 1) const {
    return GetParam().make(scene.system, step, seed);
  }
};

/// Those of the methods that declare it.
class SymmetricIntegratorLaws : public IntegratorLaws {};
class BoundedEnergyIntegratorLaws : public IntegratorLaws {};

inline std::vector<Method> methods_that_declare(bool Method::* property) {
  std::vector<Method> found;
  for (const Method& method : methods)
    if (method.*property) found.push_back(method);
  return found;
}

/// Root mean square over seeds of the error of the planet's position and velocity at t = 1.
inline double error_at_one(const Method& method, double e, double step) {
  const Scene scene = planet(e);
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

TEST_P(IntegratorLaws, TheErrorFallsWithTheDeclaredOrder) {
  // Kepler e = .1 up to t = 1, steps 1/16 and 1/64, or as declared. The slope differs from the order by a h / ln 4,
  // a h the next term of the error: 0.02 for most. Each of two samples of 1000 seeds adds sqrt(2/1000) / 2 / ln 4 = 0.02.
  const Method& method = GetParam();
  if (method.coarse_step == 0)
    GTEST_SKIP() << "two steps of ratio 4 do not show the order of " << method.name;
  const double coarse = error_at_one(method, 0.1, method.coarse_step),
               fine = error_at_one(method, 0.1, method.coarse_step / 4);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), method.order, method.next_term)
      << coarse << " and " << fine << ", seeds 1 .. 1000";
}

TEST_P(IntegratorLaws, MotionsOfItsDegreeAreExact) {
  // Free fall is of degree 2; without a field, of degree 1.
  if (GetParam().exact_degree < 0) GTEST_SKIP() << GetParam().name << " perturbs every motion";
  ASSERT_GE(GetParam().exact_degree, 1);
  Scene scene = free_fall();
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
  const Scene scene = spring_cube(1);
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
  const Scene scene = planet(0.3);
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
  const Scene scene = spring_cube(2);
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
  Scene scene = spring_cube(2);
  scene.start.time = 3.0;
  State<double> state = scene.start;
  Report report;
  make(scene, 0.1)->step(state, 1.0, report);
  EXPECT_EQ(state.time, 3.0);
}

TEST_P(IntegratorLaws, ThePieceIsTheStep) {
  const Scene scene = spring_cube(3);
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
  Scene coincident = falling_together(0.0);
  Scene collapsed = dumbbell(1.0, 1.0, 1.0);
  collapsed.start.position.setZero();
  Scene late = oscillator();
  late.start.time = 1e20;
  const Scene huge = oscillator(1.0, 1e308, 1e308);
  using Case = std::pair<const Scene*, Outcome>;
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
  Scene scene = spring_cube(4);
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
  const Scene scene = spring_cube(5);
  const State<double> one = after(scene, make(scene, 0.1, 7), 2.0),
                      two = after(scene, make(scene, 0.1, 7), 2.0);
  const State<double> other = after(scene, make(scene, 0.1, 8), 2.0);
  EXPECT_EQ(one.position, two.position) << "seed 7";
  EXPECT_EQ(one.velocity, two.velocity) << "seed 7";
  EXPECT_EQ(one.position != other.position, GetParam().random) << "seeds 7 and 8";
}

TEST_P(IntegratorLaws, StepsAndUpdatesAreCounted) {
  Scene scene = spring_cube(6);
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

}  // namespace jetlag::testing
