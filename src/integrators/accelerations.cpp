// SPDX-License-Identifier: MIT
#include "jetlag/integrators/accelerations.hpp"

#include <algorithm>

namespace jetlag {

bool forces_read(const System<double>& system, Input::Kind kind) {
  return std::ranges::any_of(system.elements(),
                             [kind](const auto& elements) { return reads(elements.law, kind); });
}

Accelerations::Accelerations(const System<double>& system)
    : series_(system, 2),
      depend_on_velocity_(forces_read(system, Input::Kind::velocity)),
      depend_on_time_(forces_read(system, Input::Kind::time)) {}

/// Whether the forces at this state are those of the one before.
bool Accelerations::knows_forces(const State<double>& state) const {
  return (!depend_on_time_ || last_.time == state.time) && last_.position.size() == state.position.size() &&
         last_.position == state.position && (!depend_on_velocity_ || last_.velocity == state.velocity);
}
/// Whether the series begins at this state, as far as orders beyond 1 are concerned.
bool Accelerations::knows(const State<double>& state) const {
  return knows_forces(state) && last_.velocity == state.velocity;
}

void Accelerations::begin(const State<double>& state) {
  if (knows(state)) return;
  last_.time = state.time;
  last_.position = state.position;
  last_.velocity = state.velocity;
  series_.start(last_);
}

bool Accelerations::operator()(const State<double>& state, Coordinates<double>& a, Report& report) {
  if (!knows_forces(state)) begin(state);
  if (series_.order() < 2) {
    series_.grow();
    ++coefficients_;
  }
  a = 2.0 * series_.position(2);  // x_2 = x'' / 2
  return a.allFinite() || all_finite(series_, report);
}

bool Accelerations::operator()(const State<double>& state, std::vector<Coordinates<double>>& derivatives,
                               Report& report) {
  begin(state);
  const int order = static_cast<int>(derivatives.size()) + 1;
  if (order > series_.order()) {
    coefficients_ += order - series_.order();
    series_.grow_to(order);
  }
  double factorial = 1;
  bool finite = true;
  for (std::size_t k = 0; k < derivatives.size(); ++k) {
    factorial *= static_cast<double>(k + 2);
    derivatives[k] = factorial * series_.position(static_cast<int>(k) + 2);
    finite = finite && derivatives[k].allFinite();
  }
  return finite || all_finite(series_, report);
}

Report Accelerations::underflow(const State<double>& state, double h) {
  last_ = {};
  series_.start(state);
  return step_underflow(series_, h);
}

}  // namespace jetlag
