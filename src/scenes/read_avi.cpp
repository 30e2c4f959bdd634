// SPDX-License-Identifier: MIT
// "integrator": {"type": "avi"}: a clock for each element; "control" says how long their steps are.
#include <algorithm>
#include <limits>

#include "jetlag/scenes/error.hpp"
#include "jetlag/schedule/avi.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

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
ElementSteps read_element_steps(const Value& control, const System<double>& system) {
  const auto step = control.find("step"), courant = control.find("courant");
  if (!step && !courant) control.refuse("an object with a step, a fraction courant, or both");
  ElementSteps steps = step ? read_steps(*step, system) : ElementSteps{};
  if (!courant) return steps;
  const double share = courant->number(fraction);
  const ElementSteps limits = checked(*courant, [&] { return courant_steps(system, share); });
  if (!step) return limits;
  for (std::size_t g = 0; g < steps.size(); ++g)
    std::ranges::transform(steps[g], limits[g], steps[g].begin(),
                           [](double a, double b) { return std::min(a, b); });
  return steps;
}

}  // namespace

Method read_avi(const Value& scene, std::shared_ptr<const System<double>> system) {
  const Value integrator = scene.at("integrator"), control = scene.at("control"),
              schedule = scene.at("schedule", Json{{"type", "asynchronous"}});
  integrator.only({"type", "resonance"});
  schedule.only({"type", "max_steps"}).at("type", "asynchronous").one_of({"asynchronous"});
  if (!control.is_object()) control.refuse("an object with a type");
  if (control.only({"type", "step", "courant"}).at("type", "fixed").text() != "fixed")
    control.at("type").refuse("fixed, which is what avi works with");
  ElementSteps steps = read_element_steps(control, *system);
  if (integrator.at("resonance", "allowed").one_of({"allowed", "avoided"}) == "avoided")
    steps = checked(integrator.at("resonance"), [&] { return without_resonance(*system, steps); });
  checked(integrator.at("type"), [&] { Avi(*system, steps); });

  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  const auto max_steps = schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most;
  return {[system, steps] { return std::make_unique<Avi>(*system, steps); },
          std::nullopt,
          static_cast<std::uint64_t>(max_steps),
          1,
          std::nullopt,
          1.0,
          2};
}

}  // namespace jetlag
