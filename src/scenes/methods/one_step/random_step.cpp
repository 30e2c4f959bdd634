// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/random_step.hpp"

#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_random_step(const StepperArguments& arguments) {
  const Value& integrator = arguments.integrator;
  RandomStep::Options options;
  options.step = read_step(arguments);
  options.order = integrator.at("order").number({0.5, infinite, false, false, "a number > 0.5"});
  const std::string name = integrator.at("distribution", "uniform").one_of(names_of_step_distributions);
  options.distribution = name == "uniform" ? StepDistribution::uniform : StepDistribution::lognormal;
  options.seed = arguments.seed;
  const auto inner = read_inner(arguments);
  return one_step_method(arguments, inner.mean_orders, [options, make = inner.make] {
    return std::make_unique<RandomStep>(make(), options);
  });
}

/// Random lengths of order p for leapfrog, of order 2.
Promise random_step_promise(double p) {
  constexpr auto distribution = StepDistribution::lognormal;
  return {.name = p < 2 ? "random_step_below_lognormal" : "random_step_at_order_lognormal",
          .order = std::min(p, 2.0),
          .exact_degree = -1,
          .make = [=](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<RandomStep>(
                std::make_unique<Leapfrog>(system, 1e300),
                RandomStep::Options{.step = step, .order = p, .distribution = distribution, .seed = seed});
          }};
}

}  // namespace

MethodRecord random_step() {
  return {
      .name = "random_step",
      .what = "Another method with random lengths of its steps",
      .when =
          "An ensemble about a deterministic method, as with `conrad`, that keeps what the method "
          "keeps: momentum, a symplectic flow.",
      .declared = {{"integrators/perturbed/random_step.hpp", "RandomStep"},
                   {"integrators/perturbed/random_step.hpp", "StepDistribution"}},
      .keys = joined({{inner,
                       {"integrator.order", "p > 0.5, best the order of the inner method", "required"},
                       {"integrator.distribution", "`uniform`, for steps below 1 s; `lognormal`", "uniform"}},
                      fixed}),
      .examples =
          {R"({"integrator": {"type": "random_step", "inner": {"type": "implicit_midpoint"}, "order": 2},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs =
          {{"1e-12",
            "angular momentum of a perturbed planet by the midpoint rule with random steps, up to t = 40",
            "RandomStep.KeepsTheAngularMomentumThatTheMidpointRuleKeeps",
            "integrators/implicit/implicit_test.cpp"},
           {"std::pow(h, 2 * p + 1) / 3",
            "what random lengths add to the second moment of y' = -y by Euler's method",
            "RandomStep.TheSecondMomentOfADecayIsInClosedForm", "integrators/perturbed/perturbed_test.cpp"}},
      .promises = {random_step_promise(1.5), random_step_promise(2)},
      .draws = true,
      .stepper = read_random_step};
}

}  // namespace jetlag::methods
