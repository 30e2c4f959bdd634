// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit/explicit_implicit.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_explicit_implicit(const StepperArguments& arguments) {
  const double step = read_step(arguments);
  const auto implicit =
      read_implicit_particles(arguments.integrator, *arguments.system, arguments.start, step);
  return one_step_method(arguments, 4.0, [system = arguments.system, step, implicit] {
    return std::make_unique<ExplicitImplicit>(*system, step, implicit);
  });
}

/// Every second particle is implicit.
std::unique_ptr<Integrator> every_second(const System<double>& system, double step, std::uint64_t) {
  std::vector<bool> implicit(system.particles());
  for (int i = 1; i < system.particles(); i += 2) implicit[i] = true;
  return std::make_unique<ExplicitImplicit>(system, step, implicit);
}

}  // namespace

MethodRecord explicit_implicit() {
  return {.name = "explicit_implicit",
          .what = "Leapfrog for most particles, Newmark's method for the stiff ones, in one step",
          .when =
              "A few stiff particles in a large scene, at one step that suits the rest: nothing resonates, "
              "and only the stiff ones are solved for.",
          .declared = {{"integrators/implicit/explicit_implicit.hpp", "ExplicitImplicit"}},
          .keys = joined(
              {{{"integrator.implicit",
                 "a list of particles that are not fixed, or `courant`: those whose limit is below the step",
                 "required"}},
               fixed}),
          .examples = {R"({"integrator": {"type": "explicit_implicit", "implicit": [2, 3]},
 "control": {"type": "fixed", "step": 0.01}})",
                       R"({"integrator": {"type": "explicit_implicit", "implicit": "courant"},
 "control": {"type": "fixed", "step": 0.1}})"},
          .proofs = {{"1.035276180410083",
                      "the limit of the step on a chain of ten masses, five implicit, however stiff these",
                      "ExplicitImplicit.IsStableUpToTheLimitOfTheExplicitParticles",
                      "integrators/implicit/explicit_implicit_test.cpp"},
                     {"99.3", "times that of leapfrog where the implicit half is 10000 times stiffer",
                      "ExplicitImplicit.GainsAHundredfoldOnLeapfrog",
                      "integrators/implicit/explicit_implicit_test.cpp"}},
          .promises = {{.name = "explicit_implicit",
                        .order = 2,
                        .exact_degree = 2,
                        .symmetric = true,
                        .energy_bounded = true,
                        .make = every_second}},
          .stepper = read_explicit_implicit};
}

}  // namespace jetlag::methods
