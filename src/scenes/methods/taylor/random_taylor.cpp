// SPDX-License-Identifier: MIT
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"
#include "scenes/methods/taylor/series.hpp"

namespace jetlag::methods {

namespace {

Stepper read_random_taylor(const StepperArguments& arguments) {
  const auto& [integrator, control, system, seed, threads, start] = arguments;
  const Truncation law = read_truncation(integrator);
  if (const auto tolerance = tolerance_of_degree(control))
    tolerance->refuse("left out for random_taylor, whose degrees are given");
  require_control_for(law, control);
  const bool shared_draw = integrator.at("shared_draw", true).boolean();
  if (!shared_draw && !system->changing().empty())
    integrator.at("shared_draw")
        .refuse("true beside a contact, whose elements come and go for all particles");
  const Draw draws = read_draws(integrator, law, shared_draw, system->particles());
  return series_method(arguments, law, shared_draw, draws);
}

Promise random_taylor_promise(int min_degree, int max_degree, bool shared_draw, VelocitySeries velocity) {
  const bool derivative = velocity == VelocitySeries::derivative;
  return {.name = "random_taylor_" + std::to_string(min_degree) + "_" + std::to_string(max_degree) +
                  (shared_draw ? "_shared" : "_each") + (derivative ? "_derivative" : "_own_series"),
          // With `derivative`, velocities are one order worse, and the positions after them.
          .order = std::min<double>(max_degree, min_degree + 0.5) - (derivative ? 1 : 0),
          .exact_degree = min_degree,
          .make = [=](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<RandomTaylor>(system, geometric(min_degree, max_degree, 0.5),
                                                  std::make_unique<FixedStep>(step),
                                                  RandomTaylor::Options{seed, shared_draw, velocity});
          }};
}

}  // namespace

MethodRecord random_taylor() {
  return {
      .name = "random_taylor",
      .what = "Taylor's method, stopped at a random degree with weights that keep it unbiased",
      .when =
          "An ensemble whose spread is wanted (`jetlag ensemble`); or many steps of a low degree on a "
          "long regular motion, with the draws of the `ruler`. Not for one smooth run to many digits: "
          "there `taylor` is cheaper.",
      .declared = {{"integrators/taylor.hpp", "RandomTaylor"},
                   {"truncation/truncation.hpp", "TruncationLaw"}},
      .keys = joined(
          {truncation_keys(),
           {{"integrator.shared_draw", "true: one draw for all particles; false: one for each", "true"}},
           series_keys()}),
      .examples =
          {R"({"integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4},
 "control": {"type": "fixed", "step": 0.01, "courant": 0.9}})",
           R"({"integrator": {"type": "random_taylor", "min_degree": 5, "max_degree": 16, "base": 3, "draws": "ruler"},
 "control": {"type": "fixed", "step": 0.01}})",
           R"({"integrator": {"type": "random_taylor", "law": "poisson", "min_degree": 3, "max_degree": 12,
                "mean": 1.5},
 "control": {"type": "variance", "step": 0.01, "tolerance_random": 1e-6, "tolerance_bias": 1e-6}})",
           R"({"integrator": {"type": "random_taylor", "law": "tail", "tail": [1, 1, 1, 0.5, 0.2]},
 "control": {"type": "halve_double", "step": 0.01, "max_step": 0.1, "min_variance": 1e-16, "max_variance": 1e-10}})",
           R"({"integrator": {"type": "random_taylor", "law": "variance_capped", "terms": [1, 1, 0.5, 0.1, 0.01],
                "max_variance": 1e-4},
 "control": {"type": "last_two", "tolerance": 1e-9}})",
           R"({"integrator": {"type": "random_taylor", "law": "sequential", "min_degree": 3, "max_degree": 12,
                "target": 1e-9},
 "control": {"type": "jorba_zou"}})",
           R"({"integrator": {"type": "random_taylor", "law": "single_term", "min_degree": 3, "max_degree": 6,
                "shared_draw": false},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"2.0838e-11",
                  "growth of the mean square of an oscillator in a step h omega = 0.1, degrees 3 to 6, p = "
                  "1/2, own_series",
                  "RandomTaylor.GrowsInMeanSquareAsPublished", "integrators/random_taylor_test.cpp"},
                 {"1.52952e-8", "the same with `derivative`", "RandomTaylor.GrowsInMeanSquareAsPublished",
                  "integrators/random_taylor_test.cpp"}},
      .promises = {random_taylor_promise(1, 4, true, VelocitySeries::own_series),
                   random_taylor_promise(2, 4, true, VelocitySeries::own_series),
                   random_taylor_promise(3, 6, true, VelocitySeries::own_series),
                   random_taylor_promise(3, 6, false, VelocitySeries::own_series),
                   random_taylor_promise(3, 6, true, VelocitySeries::derivative),
                   random_taylor_promise(3, 6, false, VelocitySeries::derivative)},
      .draws = true,
      .threaded = true,
      .follows_contacts = true,
      .stepper = read_random_taylor};
}

}  // namespace jetlag::methods
