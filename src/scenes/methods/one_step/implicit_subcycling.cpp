// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit/implicit_subcycling.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

/// "coarse" and "ratio"; "control" has the step of the fine.
Stepper read_implicit_subcycling(const StepperArguments& arguments) {
  const Value& integrator = arguments.integrator;
  const System<double>& system = *arguments.system;
  constexpr int most = 1000000;
  ImplicitSubcycling::Options options;
  options.step = read_step(arguments);
  options.ratio = static_cast<int>(integrator.at("ratio").integer(1, most));
  const std::vector<bool> coarse = read_partition(integrator.at("coarse"), system);
  for (int i = 0; i < system.particles(); ++i)
    if (coarse[i]) options.coarse.push_back(i);
  auto stepper = one_step_method(arguments, 4.0 * options.ratio, [system = arguments.system, options] {
    return std::make_unique<ImplicitSubcycling>(*system, options);
  });
  stepper.cycle = options.ratio;
  return stepper;
}

/// A step is a cycle of two; every second particle is coarse.
std::unique_ptr<Integrator> cycles_of_two(const System<double>& system, double step, std::uint64_t) {
  ImplicitSubcycling::Options options{.step = step / 2, .ratio = 2, .coarse = {}};
  for (int i = 1; i < system.particles(); i += 2) options.coarse.push_back(i);
  return std::make_unique<ImplicitSubcycling>(system, options);
}

}  // namespace

MethodRecord implicit_subcycling() {
  return {
      .name = "implicit_subcycling",
      .what = "The trapezoidal rule with long steps for some particles and short ones for the others",
      .when =
          "A fast part of a stiff scene: all steps may lie far beyond the limit of explicit methods, "
          "and only the part whose motion is to be resolved takes the short ones. Its cost grows with "
          "the interface: every short step solves for each component of the coarse particles that share "
          "an element with a fine one. Drag and forces of the time are welcome.",
      .declared = {{"integrators/implicit/implicit_subcycling.hpp", "ImplicitSubcycling"}},
      .keys =
          joined({{{"integrator.coarse",
                    "a list of the particles with long steps, each once; the others are fine", "required"},
                   {"integrator.ratio", "m of the long step to the short one, whole number from 1 to 1000000",
                    "required"}},
                  fixed_step("dt of fine particles [s], > 0; coarse ones take m dt")}),
      .examples = {R"({"integrator": {"type": "implicit_subcycling", "coarse": [4, 5, 6, 7], "ratio": 5},
 "control": {"type": "fixed", "step": 0.01}})"},
      .proofs =
          {{"1e-12",
            "the most by which the energy changes, relatively, in 10000 cycles of linear forces, dt ten "
            "times the explicit limit, m = 3 and 10",
            "ImplicitSubcycling.KeepsTheEnergyOfLinearForces",
            "integrators/implicit/implicit_subcycling_test.cpp"},
           {"2.0, 0.1",
            "its order, measured at m = 1, 2, 5 and 10 on springs with drag, and how far it may be off",
            "ImplicitSubcycling.HasOrderTwoAtAnyRatio", "integrators/implicit/implicit_subcycling_test.cpp"},
           {"1e-13", "momentum of a cube of springs, half of it coarse, after 40 cycles",
            "ImplicitSubcycling.KeepsMomentumToRounding",
            "integrators/implicit/implicit_subcycling_test.cpp"}},
      .promises = {{.name = "implicit_subcycling",
                    .order = 2,
                    .exact_degree = 2,
                    .symmetric = true,
                    .energy_bounded = true,
                    .make = cycles_of_two}},
      .stepper = read_implicit_subcycling};
}

}  // namespace jetlag::methods
