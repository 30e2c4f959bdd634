// SPDX-License-Identifier: MIT
// The steps of the elements of an asynchronous variational integrator.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "jetlag/base/text.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/schedule/avi.hpp"
#include "schedule/nested_steps.hpp"

namespace jetlag {

namespace {

/// omega_K^2 of element e, 0 without a stiffness.
double squared_frequency(const System<double>& system, const Elements<double>& group, std::size_t e) {
  const RecordedLaw& law = group.law;
  if (law.stiffness == nullptr) return 0;
  double inverse_mass = 0;
  for (int i = 0; i < law.participants; ++i) {
    const int particle = group.particles[e * law.participants + i];
    if (!system.fixed()[particle]) inverse_mass += 1.0 / system.mass()[particle];
  }
  return inverse_mass * law.stiffness(&group.parameters[e * law.parameters.size()]);
}

double shortest(const ElementSteps& steps) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& group : steps)
    for (const double step : group) least = std::min(least, step);
  return least;
}

/// The shortest step that a particle takes part in.
std::vector<double> shortest_of_particles(const System<double>& system, const ElementSteps& steps) {
  std::vector<double> least(system.particles(), std::numeric_limits<double>::infinity());
  for (std::size_t g = 0; g < steps.size(); ++g) {
    const auto& group = system.elements()[g];
    for (std::size_t e = 0; e < group.count(); ++e)
      for (int i = 0; i < group.law.participants; ++i) {
        double& of_particle = least[group.particles[e * group.law.participants + i]];
        of_particle = std::min(of_particle, steps[g][e]);
      }
  }
  return least;
}

}  // namespace

ElementSteps equal_steps(const System<double>& system, double step) {
  ElementSteps steps;
  for (const auto& group : system.elements()) steps.emplace_back(group.count(), step);
  return steps;
}

namespace {

/// of_elements: omega_e of those that have no stiffness, by group; empty where it is not known.
ElementSteps steps_of(const System<double>& system, const std::vector<std::vector<double>>& of_elements,
                      double fraction) {
  if (!(fraction > 0 && fraction <= 1))
    throw std::invalid_argument("courant must be in (0, 1], got " + shown(fraction));
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  ElementSteps steps = equal_steps(system, unlimited);
  double longest = 0;
  for (std::size_t g = 0; g < steps.size(); ++g) {
    const auto& group = system.elements()[g];
    const bool known =
        group.law.stiffness != nullptr || group.law.force.is_static() ||
        (!of_elements.empty() && !group.law.unbounded && reads(group.law, Input::Kind::position));
    if (group.count() > 0 && !known)
      throw std::invalid_argument(
          "courant: no stiffness is known of " + group.law.name +
          ", so that nothing bounds its step; leave courant out and give a step for each "
          "force (control.step)");
    for (std::size_t e = 0; e < steps[g].size(); ++e)
      if (const double omega = group.law.stiffness != nullptr || of_elements.empty()
                                   ? std::sqrt(squared_frequency(system, group, e))
                                   : of_elements[g][e];
          omega > 0) {
        steps[g][e] = fraction * 2.0 / omega;
        longest = std::max(longest, steps[g][e]);
      }
  }
  if (longest == 0)
    throw std::invalid_argument("courant: no element has a stiffness that limits its step; give a step");
  const std::vector<double> least = shortest_of_particles(system, steps);
  for (std::size_t g = 0; g < steps.size(); ++g)
    for (std::size_t e = 0; e < steps[g].size(); ++e)
      if (steps[g][e] == unlimited) {
        const auto& group = system.elements()[g];
        for (int i = 0; i < group.law.participants; ++i)
          steps[g][e] = std::min(steps[g][e], least[group.particles[e * group.law.participants + i]]);
        steps[g][e] = std::min(steps[g][e], longest);
      }
  return steps;
}

ElementSteps nested_steps(double omega, ElementSteps steps) {
  const NestedSteps nested(omega, shortest(steps));
  for (auto& group : steps)
    for (double& step : group) step = nested(step);
  return steps;
}

}  // namespace

ElementSteps courant_steps(const System<double>& system, double fraction) {
  return steps_of(system, {}, fraction);
}

ElementSteps courant_steps(const System<double>& system, const State<double>& state, double fraction) {
  if (!bounds_need_state(system)) return courant_steps(system, fraction);
  return steps_of(system, frequency_bounds_of_elements(system, state), fraction);
}

ElementSteps without_resonance(const System<double>& system, ElementSteps steps) {
  return nested_steps(frequency_bound(system), std::move(steps));
}

ElementSteps without_resonance(const System<double>& system, const State<double>& state, ElementSteps steps) {
  return nested_steps(frequency_bound(system, state), std::move(steps));
}

}  // namespace jetlag
