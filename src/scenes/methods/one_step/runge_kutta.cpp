// SPDX-License-Identifier: MIT
// The methods of Runge and Kutta: a table each.
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

Promise table_promise(const RungeKuttaTable& table, double coarse_step = 1.0 / 16, double next_term = 0.1) {
  return {.name = table.name,
          .order = static_cast<double>(table.order),
          .exact_degree = table.order,
          .coarse_step = coarse_step,
          .next_term = next_term,
          .make = [&table](const System<double>& system, double step, std::uint64_t) {
            return std::make_unique<RungeKutta>(system, table, step);
          }};
}

template <const RungeKuttaTable& table()>
Stepper read_fixed(const StepperArguments& arguments) {
  return one_step_method(arguments, table().stages(),
                         [system = arguments.system, step = read_step(arguments)] {
                           return std::make_unique<RungeKutta>(*system, table(), step);
                         });
}

/// A method that estimates its own error.
template <const RungeKuttaTable& table()>
Stepper read_embedded(const StepperArguments& arguments) {
  const Value& control = arguments.control;
  if (control.at("type").text() == "fixed") return read_fixed<table>(arguments);
  const EmbeddedControl embedded{control.at("tolerance").number(positive), read_max_step(control)};
  return one_step_method(arguments, table().stages(), [system = arguments.system, embedded] {
    return std::make_unique<RungeKutta>(*system, table(), embedded);
  });
}

}  // namespace

MethodRecord euler() {
  return {
      .name = "euler",
      .what = "Euler's explicit method, of order 1",
      .when =
          "To compare with, and as the `inner` method of those that perturb another. Oscillations grow "
          "at any step.",
      .declared = {{"integrators/explicit/rk4.hpp", "euler"},
                   {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
      .keys = fixed,
      .examples = {R"({"integrator": {"type": "euler"},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"1e4 * eps",
                  "its table misses the condition of order 1 by no more, and that of order 2 by over 1e-7",
                  "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                  "integrators/explicit/runge_kutta_test.cpp"}},
      .promises = {table_promise(jetlag::euler())},
      .stepper = read_fixed<jetlag::euler>};
}

MethodRecord rk4() {
  return {
      .name = "rk4",
      .what = "The classical method of Runge and Kutta, of order 4",
      .when =
          "Short runs to some digits, with forces of any kind: four evaluations a step. Over long runs "
          "its energy drifts.",
      .declared = {{"integrators/explicit/rk4.hpp", "rk4"},
                   {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
      .keys = fixed,
      .examples = {R"({"integrator": {"type": "rk4"},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"1e4 * eps",
                  "its table misses none of the 8 conditions up to order 4 by more, and one of order 5 by "
                  "over 1e-7",
                  "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                  "integrators/explicit/runge_kutta_test.cpp"}},
      .promises = {table_promise(jetlag::rk4())},
      .stepper = read_fixed<jetlag::rk4>};
}

MethodRecord dopri5() {
  return {.name = "dopri5",
          .what = "The method of Dormand and Prince of order 5(4)",
          .when =
              "Forces of any kind to medium accuracy, with steps that follow the motion; the "
              "general-purpose method of most programs.",
          .declared = {{"integrators/explicit/dopri5.hpp", "dopri5"},
                       {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
          .keys = fixed_or("embedded", tolerance),
          .examples = {R"({"integrator": {"type": "dopri5"},
 "control": {"type": "embedded", "tolerance": 1e-8}})",
                       R"({"integrator": {"type": "dopri5"},
 "control": {"type": "fixed", "step": 0.01}})"},
          .proofs = {{"dopri5().error), 4",
                      "its estimate is the difference to a method of order 4 and of no more",
                      "RungeKutta.EstimatesAreDifferencesToMethodsOfTheirOrder",
                      "integrators/explicit/runge_kutta_test.cpp"},
                     {"1 + 6 * (result.work.steps + result.work.rejected)",
                      "six force evaluations for each step tried",
                      "RungeKutta.ARejectedStepIsTriedAgainAndCounted",
                      "integrators/explicit/runge_kutta_test.cpp"}},
          .promises = {table_promise(jetlag::dopri5(), 1.0 / 32,
                                     0.2)},  // 0.15 here, 0.29 at 1/16: its first term is small
          .stepper = read_embedded<jetlag::dopri5>};
}

MethodRecord dop853() {
  return {
      .name = "dop853",
      .what = "The method of Dormand and Prince of order 8(5,3)",
      .when =
          "Forces of any kind to high accuracy, tolerances below some 1e-8, with steps that follow the "
          "motion.",
      .declared = {{"integrators/explicit/dop853.hpp", "dop853"},
                   {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
      .keys = fixed_or("embedded", tolerance),
      .examples = {R"({"integrator": {"type": "dop853"},
 "control": {"type": "embedded", "tolerance": 1e-11}})",
                   R"({"integrator": {"type": "dop853"},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs = {{"1u + 1 + 2 + 4 + 9 + 20 + 48 + 115", "so many trees up to order 8 give a condition each",
                  "RungeKutta.ThereAre200TreesUpToOrderEight", "integrators/explicit/runge_kutta_test.cpp"},
                 {"1e4 * eps", "its table misses none of these 200 conditions by more",
                  "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                  "integrators/explicit/runge_kutta_test.cpp"}},
      .promises = {table_promise(jetlag::dop853(), 1.0 / 4)},  // shorter steps are accurate to rounding
      .stepper = read_embedded<jetlag::dop853>};
}

}  // namespace jetlag::methods
