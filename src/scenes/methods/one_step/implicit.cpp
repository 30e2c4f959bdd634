// SPDX-License-Identifier: MIT
// Methods that solve for all particles at once.
#include "jetlag/integrators/implicit/implicit.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

template <class M>
Stepper read_implicit(const StepperArguments& arguments) {
  return one_step_method(arguments, 4.0, [system = arguments.system, step = read_step(arguments)] {
    return std::make_unique<M>(*system, step);
  });
}

}  // namespace

MethodRecord implicit_midpoint() {
  return {
      .name = "implicit_midpoint",
      .what = "The implicit midpoint rule, of order 2, by Newton's method with exact Jacobians",
      .when =
          "Stiff scenes with steps far beyond the limit of explicit methods, where momentum and angular "
          "momentum are to be kept; damping is welcome.",
      .declared = {{"integrators/implicit/implicit.hpp", "ImplicitMidpoint"}},
      .keys = fixed,
      .examples = {R"({"integrator": {"type": "implicit_midpoint"},
 "control": {"type": "fixed", "step": 0.1}})"},
      .proofs = {{"100 * 1e3 * eps", "energy of an oscillator after 100 steps with h omega = 1000",
                  "Implicit.StiffOscillatorsKeepTheirAmplitude", "integrators/implicit/implicit_test.cpp"},
                 {"40 * 8 * eps", "x of an oscillator after 40 steps, which turn it by 2 atan(h/2)",
                  "Implicit.TurnsAnOscillatorByTheCayleyTransform",
                  "integrators/implicit/implicit_test.cpp"}},
      .promises = {{.name = "implicit_midpoint",
                    .order = 2,
                    .exact_degree = 2,
                    .symmetric = true,
                    .energy_bounded = true,
                    .make = made<ImplicitMidpoint>}},
      .stepper = read_implicit<ImplicitMidpoint>};
}

MethodRecord newmark() {
  return {
      .name = "newmark",
      .what =
          "Newmark's method with the mean acceleration, of order 2, by Newton's method with exact Jacobians",
      .when =
          "Stiff and mostly linear scenes with steps far beyond the limit of explicit methods: there it "
          "conserves the energy.",
      .declared = {{"integrators/implicit/implicit.hpp", "Newmark"}},
      .keys = fixed,
      .examples = {R"({"integrator": {"type": "newmark"},
 "control": {"type": "fixed", "step": 0.1}})"},
      .proofs = {{"100 * 1e6 / 4 * eps", "energy of an oscillator after 100 steps with h omega = 1000",
                  "Implicit.StiffOscillatorsKeepTheirAmplitude", "integrators/implicit/implicit_test.cpp"},
                 {"40 * 8 * eps", "x of an oscillator after 40 steps, which turn it by 2 atan(h/2)",
                  "Implicit.TurnsAnOscillatorByTheCayleyTransform",
                  "integrators/implicit/implicit_test.cpp"}},
      .promises = {{.name = "newmark",
                    .order = 2,
                    .exact_degree = 2,
                    .symmetric = true,
                    .energy_bounded = true,
                    .make = made<Newmark>}},
      .stepper = read_implicit<Newmark>};
}

}  // namespace jetlag::methods
