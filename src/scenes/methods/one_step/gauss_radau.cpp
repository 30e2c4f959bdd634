// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/gauss_radau.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

/// "fixed", or "embedded": by the last coefficient of its polynomial, to a tolerance of 1e-9 of the accelerations.
Stepper read_gauss_radau(const StepperArguments& arguments) {
  const Value& control = arguments.control;
  GaussRadau::Options options;
  if (control.at("type").text() == "fixed") {
    options.step = read_step(arguments);
  } else {
    options.tolerance = control.at("tolerance", options.tolerance).number(positive);
    options.max_step = read_max_step(control);
  }
  return one_step_method(arguments, 15.0, [system = arguments.system, options] {
    return std::make_unique<GaussRadau>(*system, options);
  });
}

}  // namespace

MethodRecord gauss_radau() {
  return {
      .name = "gauss_radau",
      .what = "Gauss-Radau integration of order 15 (the method of IAS15)",
      .when =
          "Planets and other smooth motions to rounding, close encounters included, where a method "
          "other than `taylor` is wanted to compare with.",
      .declared = {{"integrators/explicit/gauss_radau.hpp", "GaussRadau"}},
      .keys = fixed_or("embedded", {"control.tolerance", "eps_b > 0", "1e-9"}),
      .examples = {R"({"integrator": {"type": "gauss_radau"},
 "control": {"type": "embedded"}})",
                   R"({"integrator": {"type": "gauss_radau"},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"15, 1.0",
                  "the power of the step with which the error falls, e = 0.8, and what the next term adds",
                  "GaussRadau.TheErrorFallsWithThePowerFifteen", "integrators/explicit/gauss_radau_test.cpp"},
                 {"1e-13",
                  "relative energy error after 100 periods of e = 0.9, in fewer than 250 steps a period",
                  "GaussRadau.KeepsTheEnergyOfAnEccentricOrbitToRounding",
                  "integrators/explicit/gauss_radau_test.cpp"}},
      .promises = {{.name = "gauss_radau",
                    .order = 15,
                    .exact_degree = 9,
                    .coarse_step = 0,
                    .make =
                        [](const System<double>& system, double step, std::uint64_t) {
                          return std::make_unique<GaussRadau>(system, GaussRadau::Options{.step = step});
                        }}},
      .stepper = read_gauss_radau};
}

}  // namespace jetlag::methods
