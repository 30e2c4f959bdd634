// SPDX-License-Identifier: MIT
#pragma once
// What methods of impulses have in common: clocks of elements (avi) and of particles (subcycling).

#include "scenes/methods/record.hpp"

namespace jetlag::methods {

/// "control" with a step, a fraction courant, or both.
inline Value require_steps(const Value& scene) {
  const Value control = scene.at("control");
  if (!control.has("step") && !control.has("courant"))
    control.refuse("an object with a step, a fraction courant, or both");
  return control;
}

inline bool avoids_resonance(const Value& integrator) {
  return integrator.at("resonance", "allowed").one_of({"allowed", "avoided"}) == "avoided";
}

inline Method impulse_method(std::function<std::unique_ptr<Schedule>()> make) {
  Method method;
  method.schedule = std::move(make);
  method.mean_orders = 1;
  method.largest_degree = 2;
  return method;
}

}  // namespace jetlag::methods
