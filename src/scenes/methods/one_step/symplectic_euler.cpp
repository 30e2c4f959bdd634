// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/symplectic_euler.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_symplectic_euler(const StepperArguments& arguments) {
  return one_step_method(arguments, 1.0, [system = arguments.system, step = read_step(arguments)] {
    return std::make_unique<SymplecticEuler>(*system, step);
  });
}

}  // namespace

MethodRecord symplectic_euler() {
  return {.name = "symplectic_euler",
          .what = "The symplectic (semi-implicit) Euler method, of order 1",
          .when =
              "To compare with: the simplest method whose energy does not drift. `leapfrog` costs as much "
              "and is of order 2. Refuses drag.",
          .declared = {{"integrators/explicit/symplectic_euler.hpp", "SymplecticEuler"}},
          .keys = fixed,
          .examples = {R"({"integrator": {"type": "symplectic_euler"},
 "control": {"type": "fixed", "step": 0.01}})"},
          .proofs = {{"x * x + v * v - h * x * v",
                      "this quantity of x'' = -x is kept to rounding over 2000 steps of h = 1/2",
                      "SymplecticEuler.ConservesItsModifiedOscillatorEnergy",
                      "integrators/explicit/symplectic_euler_test.cpp"}},
          .promises = {{.name = "symplectic_euler",
                        .order = 1,
                        .exact_degree = 1,
                        .energy_bounded = true,
                        .make = made<SymplecticEuler>}},
          .stepper = read_symplectic_euler};
}

}  // namespace jetlag::methods
