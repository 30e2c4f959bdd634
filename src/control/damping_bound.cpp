// SPDX-License-Identifier: MIT
#include "jetlag/control/damping_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "control/element_bounds.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

constexpr Input::Kind velocities = Input::Kind::velocity;

void refuse_what_does_not_damp(const ElementBounds& elements, double time) {
  if (const RecordedLaw* law = elements.first_not_positive())
    throw std::invalid_argument("courant: " + law->name +
                                " depends on velocities and does more than damp them at t = " + shown(time) +
                                " (its tangent by velocities is not symmetric and positive), so that nothing "
                                "bounds the step; leave courant out");
}

}  // namespace

double least_damping(const Model<double>& model) {
  const std::vector<double> rate = known_loads(model, velocities);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.particles(); ++i)
    if (!model.is_fixed(i)) least = std::min(least, rate[i]);
  return std::isfinite(least) ? least : 0.0;
}

double damping_bound(const Model<double>& model) { return largest(damping_bounds(model)); }

std::vector<double> damping_bounds(const Model<double>& model) { return known_bounds(model, velocities); }

bool damping_needs_state(const Model<double>& model) {
  return first_that_needs_tangents(model, velocities) != nullptr;
}

void require_damping(const Model<double>& model, const State<double>& state) {
  ElementBounds elements(model, velocities);
  if (!elements.take(state))
    throw std::invalid_argument("courant: the tangent of " + elements.culprit() +
                                " by velocities is not finite at t = " + shown(state.time) +
                                ", so that nothing bounds the step; begin elsewhere, or leave courant out");
  refuse_what_does_not_damp(elements, state.time);
}

DampingMeter::DampingMeter(const Model<double>& model)
    : elements_(std::make_unique<ElementBounds>(model, velocities)) {}
DampingMeter::DampingMeter(const DampingMeter& other)
    : elements_(std::make_unique<ElementBounds>(*other.elements_)) {}
DampingMeter::~DampingMeter() = default;

double DampingMeter::operator()(const State<double>& state) {
  return elements_->take(state) ? elements_->largest_square() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> DampingMeter::of_particles(const State<double>& state) {
  return elements_->take(state) ? elements_->bounds() : std::vector<double>();
}

void DampingMeter::require_positive(double time) const { refuse_what_does_not_damp(*elements_, time); }

}  // namespace jetlag
