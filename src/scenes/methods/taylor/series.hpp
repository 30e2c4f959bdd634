// SPDX-License-Identifier: MIT
#pragma once
// What Taylor's methods have in common, of a fixed degree and of random ones.

#include "scenes/methods/record.hpp"

namespace jetlag::methods {

/// Their keys under one clock: how the velocity is taken, all controls, the schedule.
SceneKeys series_keys();

/// A stepper of a law of degrees, with the control of the scene.
Stepper series_method(const StepperArguments& arguments, const Truncation& law, bool shared_draw, Draw draws);

/// "velocity"
VelocitySeries read_velocity_series(const Value& integrator);

/// The tolerance of jorba_zou, which stands for a degree.
std::optional<Value> tolerance_of_degree(const Value& control);

}  // namespace jetlag::methods
