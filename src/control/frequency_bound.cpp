// SPDX-License-Identifier: MIT
#include "jetlag/control/frequency_bound.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "control/element_bounds.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

constexpr Input::Kind positions = Input::Kind::position;

std::vector<double> roots(std::vector<double> squares) {
  for (double& b : squares) b = std::sqrt(b);
  return squares;
}

}  // namespace

// ---- in any state ----------------------------------------------------------------------------------------

std::vector<double> frequency_bounds(const Model<double>& model) {
  return roots(known_bounds(model, positions));
}

double frequency_bound(const Model<double>& model) { return largest(frequency_bounds(model)); }

bool bounds_need_state(const Model<double>& model) {
  return first_that_needs_tangents(model, positions) != nullptr;
}

std::string unbounded_force(const Model<double>& model) {
  const RecordedLaw* law = first_unknown(model, positions);
  return law == nullptr ? "" : law->name;
}

void require_bounded(const Model<double>& model) {
  if (const auto* law = first_that_needs_tangents(model, positions))
    throw std::invalid_argument("courant: no stiffness is known of " + law->name +
                                ", so that nothing bounds the step in all states; say at which state, or "
                                "leave courant out");
}

// ---- at a state ------------------------------------------------------------------------------------------

namespace {

/// Limits of frequencies alone are for methods whose steps are not known to be stable where velocities are damped.
void require_no_velocities(const Model<double>& model) {
  for (const auto& law : model.laws())
    if (needs_tangents(*law, positions) && has_unknown_bound(*law, Input::Kind::velocity))
      throw std::invalid_argument(
          "courant: " + law->elements().law.name +
          " depends on velocities, so that nothing bounds the step here; leave courant "
          "out, or take taylor or random_taylor, whose steps are bounded for it");
}

ElementBounds finite_elements(const Model<double>& model, const State<double>& state) {
  ElementBounds elements(model, positions);
  if (!elements.take(state))
    throw std::invalid_argument("courant: the tangent of " + elements.culprit() +
                                " is not finite at t = " + shown(state.time) +
                                ", so that nothing bounds the step; begin elsewhere, or leave courant out");
  return elements;
}

ElementBounds elements_at(const Model<double>& model, const State<double>& state) {
  require_no_velocities(model);
  return finite_elements(model, state);
}

}  // namespace

void require_finite_tangents(const Model<double>& model, const State<double>& state) {
  finite_elements(model, state);
}

FrequencyMeter::FrequencyMeter(const Model<double>& model)
    : elements_(std::make_unique<ElementBounds>(model, positions)) {}
FrequencyMeter::FrequencyMeter(const FrequencyMeter& other)
    : elements_(std::make_unique<ElementBounds>(*other.elements_)) {}
FrequencyMeter::~FrequencyMeter() = default;

double FrequencyMeter::operator()(const State<double>& state) {
  return elements_->take(state) ? std::sqrt(elements_->largest_square())
                                : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> FrequencyMeter::of_particles(const State<double>& state) {
  return elements_->take(state) ? roots(elements_->bounds()) : std::vector<double>();
}

std::vector<double> frequency_bounds(const Model<double>& model, const State<double>& state) {
  return bounds_need_state(model) ? roots(elements_at(model, state).bounds()) : frequency_bounds(model);
}

double frequency_bound(const Model<double>& model, const State<double>& state) {
  return largest(frequency_bounds(model, state));
}

std::vector<std::vector<double>> frequency_bounds_of_elements(const Model<double>& model,
                                                              const State<double>& state) {
  const auto elements = elements_at(model, state);
  std::vector<std::vector<double>> bounds(model.laws().size());
  for (std::size_t n = 0; n < bounds.size(); ++n) bounds[n].assign(model.law(n).count(), 0.0);
  for (std::size_t n = 0; n < bounds.size(); ++n) {
    const auto& [recorded, particles, parameters] = model.law(n).elements();
    if (recorded.stiffness == nullptr) continue;
    for (const int e : model.law(n).all())
      for (const int i : model.law(n).particles_of(e)) bounds[n][e] += elements.load()[i];
    bounds[n] = roots(std::move(bounds[n]));
  }
  for (const auto& law : elements.laws())
    for (const int e : law.tangents.law().all()) bounds[law.number][e] = std::sqrt(elements.square(law, e));
  return bounds;
}

}  // namespace jetlag
