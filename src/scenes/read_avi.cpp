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

std::uint64_t read_own_schedule(const Value& scene) {
  const Value schedule = scene.at("schedule", JsonText{R"({"type": "asynchronous"})"});
  schedule.only({"type", "max_steps"}).at("type", "asynchronous").one_of({"asynchronous"});
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  return static_cast<std::uint64_t>(schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most)
                                                              : most);
}

Value read_own_control(const Value& scene) {
  const Value control = scene.at("control");
  if (!control.is_object()) control.refuse("an object with a type");
  if (control.only({"type", "step", "courant"}).at("type", "fixed").text() != "fixed")
    control.at("type").refuse("fixed, which is what " + scene.at("integrator").at("type").text() +
                              " works with");
  if (!control.has("step") && !control.has("courant"))
    control.refuse("an object with a step, a fraction courant, or both");
  return control;
}

Method impulse_method(std::function<std::unique_ptr<Schedule>()> make, std::uint64_t max_steps) {
  return {std::move(make), std::nullopt, max_steps, 1, std::nullopt, 1.0, 2};
}

Method read_avi(const Value& scene, std::shared_ptr<const System<double>> system) {
  const Value integrator = scene.at("integrator");
  integrator.only({"type", "resonance"});
  checked(integrator.at("type"),
          [&] { require_potentials(*system); });  // before courant speaks of their stiffness
  const std::uint64_t max_steps = read_own_schedule(scene);
  const Value control = read_own_control(scene);
  ElementSteps steps = read_element_steps(control, *system);
  if (integrator.at("resonance", "allowed").one_of({"allowed", "avoided"}) == "avoided")
    steps = checked(integrator.at("resonance"), [&] { return without_resonance(*system, steps); });
  checked(integrator.at("type"), [&] { Avi(*system, steps); });
  return impulse_method([system, steps] { return std::make_unique<Avi>(*system, steps); }, max_steps);
}

}  // namespace jetlag
