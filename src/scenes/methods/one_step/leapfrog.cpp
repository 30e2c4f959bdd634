// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/leapfrog.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_leapfrog(const StepperArguments& arguments) {
  double step = read_step(arguments);
  if (const auto courant = read_courant(arguments.control, *arguments.system, arguments.start))
    step = std::min(step, courant->first * 2.0 / courant->second);
  return {[system = arguments.system, step] { return std::make_unique<Leapfrog>(*system, step); }, 1.0, 2};
}

}  // namespace

MethodRecord leapfrog() {
  return {
      .name = "leapfrog",
      .what = "Leapfrog in its velocity form (Stoermer, Verlet)",
      .when =
          "Long runs to some digits with forces that depend on positions only: one force evaluation a "
          "step, and an energy that does not drift. The measure of every explicit method.",
      .declared = {{"integrators/explicit/leapfrog.hpp", "Leapfrog"}},
      .keys = joined(
          {fixed,
           {{"control.courant",
             "no step exceeds this fraction of the stability limit 2 / omega of the start, > 0 and <= 1",
             "none"}}}),
      .examples = {R"({"integrator": {"type": "leapfrog"},
 "control": {"type": "fixed", "step": 0.01, "courant": 0.5}})"},
      .proofs = {{"1 - h * h / 4",
                  "v^2 + (1 - h^2/4) x^2 of x'' = -x is kept to rounding over 2000 steps of h = 1/2",
                  "Leapfrog.ConservesItsModifiedOscillatorEnergy", "integrators/explicit/leapfrog_test.cpp"},
                 {"28u * 1001",
                  "one evaluation of 28 springs in each of 1000 steps, and one before the first",
                  "Leapfrog.EvaluatesForcesOnceAStep", "integrators/explicit/leapfrog_test.cpp"}},
      .promises = {{.name = "leapfrog",
                    .order = 2,
                    .exact_degree = 2,
                    .symmetric = true,
                    .energy_bounded = true,
                    .make = made<Leapfrog>}},
      .stepper = read_leapfrog};
}

}  // namespace jetlag::methods
