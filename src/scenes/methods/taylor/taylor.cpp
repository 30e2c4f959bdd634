// SPDX-License-Identifier: MIT
#include "jetlag/integrators/taylor.hpp"

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"
#include "scenes/methods/taylor/series.hpp"

namespace jetlag::methods {

namespace {

/// "degree", or what a tolerance of jorba_zou asks for.
int read_degree(const Value& integrator, const Value& control) {
  const auto tolerance = tolerance_of_degree(control);
  if (!tolerance) return static_cast<int>(integrator.at("degree").integer(1, largest_degree));
  if (integrator.has("degree"))
    tolerance->refuse("left out where integrator.degree is given: one follows from the other");
  const int degree = jorba_zou_degree(tolerance->number({0, 1, false, false, "a number between 0 and 1"}));
  if (degree > largest_degree)
    tolerance->refuse("larger: it asks for degree " + std::to_string(degree) + ", beyond " +
                      std::to_string(largest_degree));
  return degree;
}

Stepper read_taylor(const StepperArguments& arguments) {
  const int degree = read_degree(arguments.integrator, arguments.control);
  return series_method(arguments, fixed_degree(degree), true, Draw::independent);
}

Promise taylor_promise(int degree, bool compensated = false) {
  return {.name = "taylor_" + std::to_string(degree) + (compensated ? "_compensated" : ""),
          .order = static_cast<double>(degree),
          .exact_degree = degree,
          .make = [=](const System<double>& system, double step, std::uint64_t) {
            RandomTaylor::Options options;
            options.compensated = compensated;
            return std::make_unique<RandomTaylor>(system, fixed_degree(degree),
                                                  std::make_unique<FixedStep>(step), options);
          }};
}

}  // namespace

MethodRecord taylor() {
  return {
      .name = "taylor",
      .what = "Taylor's method of a fixed degree",
      .when =
          "Smooth motions, to any accuracy: degree 12 to 20 with `jorba_zou` is the cheapest way to "
          "many digits. The method to begin with.",
      .declared = {{"integrators/taylor.hpp", "taylor"}, {"control/jorba_zou.hpp", "jorba_zou_step"}},
      .keys = joined({{{"integrator.degree", "1 to 256", "required without control.tolerance of jorba_zou"}},
                      series_keys()}),
      .examples = {R"({"integrator": {"type": "taylor", "degree": 20},
 "control": {"type": "jorba_zou"}})",
                   R"({"integrator": {"type": "taylor"},
 "control": {"type": "jorba_zou", "tolerance": 1e-12}})",
                   R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "fixed", "step": 0.01, "courant": 0.5}})",
                   R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "last_two", "tolerance": 1e-9}})",
                   R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "variance", "step": 0.01, "tolerance_random": 1e-6, "tolerance_bias": 1e-6}})",
                   R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "halve_double", "step": 0.01, "max_step": 0.1, "min_variance": 1e-16, "max_variance": 1e-10}})"},
      .proofs = {{"-1.320695160352823732570402",
                  "x of a planet of eccentricity 0.99 at t = 1000, in 75-digit arithmetic; degree 20 with "
                  "jorba_zou ends there to what an energy error of 1e-12 allows",
                  "Kepler.EndsAtThePublishedPositions", "integrators/long_runs_test.cpp"},
                 {"{0.99, 120}",
                  "at most 120 steps a period at that eccentricity, with no error but rounding",
                  "Kepler.TakesNoMoreStepsAndNoMoreErrorThanRoundingGives",
                  "integrators/long_runs_test.cpp"}},
      .promises = {taylor_promise(2), taylor_promise(3), taylor_promise(4), taylor_promise(5),
                   taylor_promise(6), taylor_promise(5, true)},
      .threaded = true,
      .follows_contacts = true,
      .stepper = read_taylor};
}

}  // namespace jetlag::methods
