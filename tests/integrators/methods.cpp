// SPDX-License-Identifier: MIT
#include "integrators/methods.hpp"

#include <algorithm>

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

namespace jetlag::testing {

namespace {

Method taylor_method(int degree) {
  return {.name = "taylor_" + std::to_string(degree),
          .order = static_cast<double>(degree),
          .exact_degree = degree,
          .make = [degree](const System<double>& system, double step, std::uint64_t) {
            return taylor(system, degree, std::make_unique<FixedStep>(step));
          }};
}

/// Degree 5 in compensated sums.
Method compensated_taylor() {
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

Method random_taylor_method(int min_degree, int max_degree, bool shared_draw, VelocitySeries velocity) {
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

Method runge_kutta_method(const RungeKuttaTable& table, double coarse_step = 1.0 / 16,
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

Method hermite_method(int iterations) {
  return {.name = "hermite_" + std::to_string(iterations),
          .order = 4,
          .exact_degree = 3,
          .symmetric = iterations > 4,  // to rounding where the corrector has come to rest
          .make = [=](const System<double>& system, double step, std::uint64_t) {
            return std::make_unique<Hermite>(system,
                                             Hermite::Options{.iterations = iterations, .step = step});
          }};
}

std::unique_ptr<Integrator> leapfrog_of_any_length(const System<double>& system) {
  return std::make_unique<Leapfrog>(system, 1e300);
}

/// Noise of order p on leapfrog, of order 2.
Method conrad_method(double p) {
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

Method random_step_method(double p, StepDistribution distribution) {
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

}  // namespace

std::vector<Method> all_methods() {
  return {
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
}

}  // namespace jetlag::testing
