// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/leapfrog.hpp"

#include "jetlag/integrators/accelerations.hpp"

namespace jetlag {

Leapfrog::Leapfrog(const System<double>& system, double step)
    : series_(system, 2),
      forces_depend_on_velocity_(forces_read(system, Input::Kind::velocity)),
      forces_depend_on_time_(forces_read(system, Input::Kind::time)),
      moving_(moving_particles(system)),
      step_(step) {
  require_positive("step", step);
}

/// a = x'' is twice coefficient 2.
bool Leapfrog::acceleration(const State<double>& state, Coordinates<double>& result, Report& report) {
  series_.start(state);
  series_.grow();
  result = 2.0 * series_.position(2);
  return result.allFinite() || all_finite(series_, report);
}

double Leapfrog::step(State<double>& state, double limit, Report& report) {
  const double h = cropped(step_, limit);
  if (!advances(state.time, h)) {
    series_.start(state);
    report = step_underflow(series_, h);
    return 0.0;
  }
  const bool known =
      !forces_depend_on_velocity_ && (!forces_depend_on_time_ || time_of_a_after_ == state.time) &&
      position_of_a_after_.size() == state.position.size() && position_of_a_after_ == state.position;
  if (!known && !acceleration(state, a_, report)) return 0.0;
  const Coordinates<double>& a = known ? a_after_ : a_;

  next_.time = state.time + h;
  next_.position = state.position + h * state.velocity + 0.5 * h * h * a;
  next_.velocity = state.velocity + h * a;
  if (!all_finite(next_.position, next_.velocity, state.time, report) ||
      !acceleration(next_, a_next_, report))
    return 0.0;
  next_.velocity = state.velocity + 0.5 * h * (a + a_next_);
  if (!all_finite(next_.position, next_.velocity, state.time, report)) return 0.0;

  a_before_ = a;
  a_after_.swap(a_next_);
  before_.time = state.time;  // storage goes round: nothing is allocated
  before_.position.swap(state.position);
  before_.velocity.swap(state.velocity);
  state.position = next_.position;
  state.velocity.swap(next_.velocity);
  state.drop_rests();
  position_of_a_after_.swap(next_.position);
  time_of_a_after_ = next_.time;
  last_step_ = h;

  ++work_.steps;
  work_.updates += moving_;
  work_.coefficients += moving_;
  work_.element_coefficients = series_.element_coefficients();
  work_.degrees += std::uint64_t{2} * moving_;
  return h;
}

/// x is a parabola and v too; both meet the end of the step exactly.
Piece Leapfrog::piece() const {
  return {before_.time,
          before_.time + last_step_,
          {before_.position, before_.velocity, 0.5 * a_before_},
          {before_.velocity, a_before_, (a_after_ - a_before_) / (2.0 * last_step_)}};
}

}  // namespace jetlag
