// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/hermite.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Promise hermite_promise(int iterations) {
  return {.name = "hermite_" + std::to_string(iterations),
          .order = 4,
          .exact_degree = 3,
          .symmetric = iterations > 4,  // to rounding where the corrector has come to rest
          .make = [=](const System<double>& system, double step, std::uint64_t) {
            return std::make_unique<Hermite>(system,
                                             Hermite::Options{.iterations = iterations, .step = step});
          }};
}

/// "fixed", or "aarseth".
Stepper read_hermite(const StepperArguments& arguments) {
  const Value& control = arguments.control;
  Hermite::Options options;
  options.iterations =
      static_cast<int>(arguments.integrator.at("iterations", options.iterations).integer(1, 20));
  if (control.at("type").text() == "fixed") {
    options.step = read_step(arguments);
  } else {
    options.accuracy = control.at("accuracy", options.accuracy).number(positive);
    options.max_step = read_max_step(control);
  }
  return one_step_method(arguments, 2.0 * (options.iterations + 1), [system = arguments.system, options] {
    return std::make_unique<Hermite>(*system, options);
  });
}

}  // namespace

MethodRecord hermite() {
  return {
      .name = "hermite",
      .what = "Hermite's method of order 4, with the jerk",
      .when =
          "Bodies under gravity to medium accuracy; with 5 iterations or more and fixed steps, long "
          "runs whose energy does not drift.",
      .declared = {{"integrators/explicit/hermite.hpp", "Hermite"}},
      .keys = joined({{{"integrator.iterations",
                        "of the corrector, 1 to 20; 1 stands for 2 where forces depend on velocities", "1"}},
                      fixed_or("aarseth", {"control.accuracy", "eta > 0", "0.01"})}),
      .examples = {R"({"integrator": {"type": "hermite"},
 "control": {"type": "aarseth"}})",
                   R"({"integrator": {"type": "hermite", "iterations": 8},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs =
          {{"1e-13",
            "x of an oscillator after 40 converged steps, which turn it by 2 atan((h/2) / (1 - h^2/12))",
            "Hermite.ConvergedStepsAreThoseOfTheFourthPadeApproximation",
            "integrators/explicit/hermite_test.cpp"},
           {"4.0, 0.1", "its order, measured with drag and with forces that depend on time",
            "Hermite.IsOfOrderFourWithDragAndWithForcesThatDependOnTime",
            "integrators/explicit/hermite_test.cpp"}},
      .promises = {hermite_promise(1), hermite_promise(20)},
      .stepper = read_hermite};
}

}  // namespace jetlag::methods
