// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/exponential_step.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_exponential_step(const StepperArguments& arguments) {
  return one_step_method(arguments, 1.0,
                         [system = arguments.system, step = read_step(arguments), seed = arguments.seed] {
                           return std::make_unique<ExponentialStep>(*system, step, seed);
                         });
}

}  // namespace

MethodRecord exponential_step() {
  return {
      .name = "exponential_step",
      .what = "Euler's method with exponentially distributed steps",
      .when =
          "To study ensembles whose moments are known in closed form. Of order 1, and stable in mean square "
          "at half of Euler's step only.",
      .declared = {{"integrators/perturbed/exponential_step.hpp", "ExponentialStep"}},
      .keys = fixed_step("the mean h [s], > 0"),
      .examples = {R"({"integrator": {"type": "exponential_step"},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"1.105", "second moment of y' = -y after a step of mean 1.05; 0.905 at 0.95",
                  "ExponentialStep.TheSecondMomentOfADecayIsInClosedForm",
                  "integrators/perturbed/perturbed_test.cpp"}},
      .promises = {{.name = "exponential_step",
                    .order = 1,
                    .exact_degree = 1,
                    .random_length = true,
                    .coarse_step = 1.0 / 64,
                    .make =
                        [](const System<double>& system, double step, std::uint64_t seed) {
                          return std::make_unique<ExponentialStep>(system, step, seed);
                        }}},
      .draws = true,
      .stepper = read_exponential_step};
}

}  // namespace jetlag::methods
