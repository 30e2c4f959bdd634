// SPDX-License-Identifier: MIT
#include "jetlag/integrators/leapfrog.hpp"

#include <algorithm>

namespace jetlag {

namespace {
/// Whether a force depends on a kind of input.
bool reads(const System<double>& system, Input::Kind kind) {
  return std::ranges::any_of(system.elements(), [kind](const auto& elements) {
    return std::ranges::any_of(elements.law.force.nodes, [kind](const Node& node) {
      return node.kind == Node::Kind::input && node.input.kind == kind;
    });
  });
}
}  // namespace

Leapfrog::Leapfrog(const System<double>& system, double step)
    : series_(system, 2),
      forces_depend_on_velocity_(reads(system, Input::Kind::velocity)),
      forces_depend_on_time_(reads(system, Input::Kind::time)),
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
  Coordinates<double> a;
  if (known)
    a = a_after_;
  else if (!acceleration(state, a, report))
    return 0.0;

  State<double> next{state.time + h, state.position + h * state.velocity + 0.5 * h * h * a,
                     state.velocity + h * a};
  if (!all_finite(next.position, next.velocity, state.time, report)) return 0.0;
  Coordinates<double> a_next;
  if (!acceleration(next, a_next, report)) return 0.0;
  next.velocity = state.velocity + 0.5 * h * (a + a_next);
  if (!all_finite(next.position, next.velocity, state.time, report)) return 0.0;

  before_ = state;
  a_before_ = std::move(a);
  a_after_ = std::move(a_next);
  position_of_a_after_ = next.position;
  time_of_a_after_ = next.time;
  state.position = std::move(next.position);
  state.velocity = std::move(next.velocity);
  state.drop_rests();
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
