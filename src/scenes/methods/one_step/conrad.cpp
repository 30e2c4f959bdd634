// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/conrad.hpp"

#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Stepper read_conrad(const StepperArguments& arguments) {
  const Value& integrator = arguments.integrator;
  Conrad::Options options;
  options.step = read_step(arguments);
  options.order = integrator.at("order").number(positive);
  options.sigma = integrator.at("sigma", 1.0).number(positive);
  options.seed = arguments.seed;
  const auto inner = read_inner(arguments);
  return one_step_method(arguments, inner.mean_orders,
                         [system = arguments.system, options, make = inner.make] {
                           return std::make_unique<Conrad>(*system, make(), options);
                         });
}

/// Noise of order p on leapfrog, of order 2.
Promise conrad_promise(double p) {
  return {.name = p < 2 ? "conrad_below" : "conrad_at_order",
          .order = std::min(p, 2.0),
          .exact_degree = -1,
          .make = [p](const System<double>& system, double step, std::uint64_t seed) {
            return std::make_unique<Conrad>(
                system, std::make_unique<Leapfrog>(system, 1e300),
                Conrad::Options{.step = step, .order = p, .sigma = 0.1, .seed = seed});
          }};
}

}  // namespace

MethodRecord conrad() {
  return {
      .name = "conrad",
      .what = "Normal noise added to another method",
      .when =
          "An ensemble about a deterministic method, with sigma fitted to its errors; no invariant "
          "survives.",
      .declared = {{"integrators/perturbed/conrad.hpp", "Conrad"}},
      .keys = joined({{inner,
                       {"integrator.order", "p > 0, best the order of the inner method", "required"},
                       {"integrator.sigma", "> 0, in SI units", "1"}},
                      fixed}),
      .examples = {R"({"integrator": {"type": "conrad", "inner": {"type": "rk4"}, "order": 4},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"5.2632e-3",
                  "variance of Euler's method with noise on y' = -y after 100 steps of 0.1, sigma = 1, p = 1",
                  "Conrad.TheVarianceOfADecayIsThatOfItsAutoregression",
                  "integrators/perturbed/perturbed_test.cpp"}},
      .promises = {conrad_promise(1.5), conrad_promise(2)},
      .draws = true,
      .stepper = read_conrad};
}

}  // namespace jetlag::methods
