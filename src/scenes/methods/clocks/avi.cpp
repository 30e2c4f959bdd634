// SPDX-License-Identifier: MIT
// A clock for each element; "control" says how long their steps are.
#include "jetlag/schedule/avi.hpp"

#include "scenes/methods/clocks/impulses.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

/// "step": one for all elements, or one for each force of the scene.
ElementSteps read_steps(const Value& step, const System<double>& system) {
  const auto of_force = step.numbers(system.elements().size(), positive, "force");
  ElementSteps steps;
  for (std::size_t f = 0; f < of_force.size(); ++f)
    steps.emplace_back(system.elements()[f].count(), of_force[f]);
  return steps;
}

/// Each step the shorter one of "step" and "courant", where both are given.
ElementSteps read_element_steps(const Value& control, const System<double>& system,
                                const State<double>& start) {
  const auto step = control.find("step"), courant = control.find("courant");
  ElementSteps steps = step ? read_steps(*step, system) : ElementSteps{};
  if (!courant) return steps;
  const double share = courant->number(fraction);
  const ElementSteps limits = checked(*courant, [&] { return courant_steps(system, start, share); });
  if (!step) return limits;
  for (std::size_t g = 0; g < steps.size(); ++g)
    std::ranges::transform(steps[g], limits[g], steps[g].begin(),
                           [](double a, double b) { return std::min(a, b); });
  return steps;
}

Method read_avi(const ScheduleArguments& arguments) {
  const auto& [scene, integrator, schedule, system, seed, threads, start] = arguments;
  checked(integrator.at("type"),
          [&] { require_potentials(*system); });  // before courant speaks of their stiffness
  ElementSteps steps = read_element_steps(require_steps(scene), *system, start);
  if (avoids_resonance(integrator))
    steps = checked(integrator.at("resonance"), [&] { return without_resonance(*system, start, steps); });
  checked(integrator.at("type"), [&] { Avi(*system, steps); });
  return impulse_method([system = system, steps] { return std::make_unique<Avi>(*system, steps); });
}

}  // namespace

MethodRecord avi() {
  return {
      .name = "avi",
      .what = "Asynchronous variational integrator: a clock for each element",
      .when =
          "Elements of very different stiffness, forces with a potential only, where momentum is to be kept "
          "to rounding and the energy must not drift; with `resonance` avoided where steps are long.",
      .declared = {{"schedule/avi.hpp", "Avi"}, {"schedule/impulses.hpp", "Impulses"}},
      .keys =
          joined({{{"control.step", "[s], > 0: of all elements, or a list with one for each force",
                    "none; step, courant or both: the shorter"},
                   {"control.courant", "the fraction of its own limit that each element takes, > 0 and <= 1",
                    "none; step, courant or both: the shorter"}},
                  own_clocks}),
      .examples = {R"({"integrator": {"type": "avi"},
 "control": {"courant": 0.2}})",
                   R"({"integrator": {"type": "avi", "resonance": "avoided"},
 "control": {"step": [0.01], "courant": 0.2}})"},
      .proofs = {{"1.0203835232",
                  "spectral radius at h = 0.14075 of the chain wall-100-A-1-B-1-wall, soft springs every "
                  "second step, in 75-digit arithmetic",
                  "AviResonance.HasTheBandsOfTheChainWithRatioTwo", "schedule/avi/avi_resonance_test.cpp"},
                 {"0.01887",
                  "largest relative energy error of ten masses at a tenth of each limit, without drift",
                  "Avi.HasTheEnergyErrorOfTheReferenceWithoutDrift", "schedule/avi/avi_test.cpp"},
                 {"1e-13", "momentum of the same after 1000 s", "Avi.KeepsMomentumToRounding",
                  "schedule/avi/avi_test.cpp"}},
      .own_schedule = read_avi};
}

}  // namespace jetlag::methods
