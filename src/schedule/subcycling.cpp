// SPDX-License-Identifier: MIT
#include "jetlag/schedule/subcycling.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "jetlag/control/courant.hpp"
#include "jetlag/integrators/accelerations.hpp"
#include "schedule/nested_steps.hpp"

namespace jetlag {

namespace {

void require_steps(const System<double>& system, const ParticleSteps& steps) {
  if (steps.size() != static_cast<std::size_t>(system.particles()))
    throw std::invalid_argument("subcycling: a step is needed for each of " +
                                std::to_string(system.particles()) + " particles, got " +
                                std::to_string(steps.size()));
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) require_positive("step", steps[i]);
}

void require_no_velocities(const System<double>& system) {
  for (const auto& group : system.elements())
    if (group.count() > 0 && reads(group.law, Input::Kind::velocity))
      throw std::invalid_argument(
          "subcycling knows velocities half a step after positions, each particle by a step of its own; " +
          group.law.name + " depends on velocities: leave it out or take another integrator");
}

}  // namespace

Subcycling::Subcycling(const System<double>& system, const ParticleSteps& steps)
    : Impulses(system, "subcycling", "particle") {
  require_no_velocities(system);
  require_steps(system, steps);
  std::map<double, std::vector<int>> particles;  // of each step
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) particles[steps[i]].push_back(i);

  std::vector<int> clock_of(system.particles(), -1);
  int clocks = 0;
  for (const auto& [step, members] : particles) {
    for (const int i : members) clock_of[i] = clocks;
    ++clocks;
  }
  const auto& groups = system.elements();
  std::vector elements(clocks, std::vector<std::vector<int>>(groups.size()));  // that act on those of a clock
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t n = 0; n < groups[g].particles.size(); ++n) {
      const int e = static_cast<int>(n / groups[g].law.participants),
                clock = clock_of[groups[g].particles[n]];
      if (clock < 0) continue;
      auto& found = elements[clock][g];
      if (found.empty() || found.back() != e) found.push_back(e);
    }
  for (auto& [step, members] : particles) {
    const int clock = clock_of[members.front()];
    add_clock(step, elements[clock], std::move(members));
  }
}

namespace {

/// omega: shape (particles).
ParticleSteps steps_of(const std::vector<double>& omega, double fraction) {
  ParticleSteps steps;
  double longest = 0;
  for (const double w : omega) {
    steps.push_back(w > 0 ? fraction * 2.0 / w : 0.0);
    longest = std::max(longest, steps.back());
  }
  if (longest == 0)
    throw std::invalid_argument("courant: no particle has a stiffness that limits its step; give a step");
  for (double& step : steps)
    if (step == 0) step = longest;
  return steps;
}

ParticleSteps nested_steps(const System<double>& system, double omega, ParticleSteps steps) {
  require_steps(system, steps);
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) shortest = std::min(shortest, steps[i]);
  const NestedSteps nested(omega, shortest, 0.5 * std::numbers::pi);
  for (double& step : steps) step = nested(step);
  return steps;
}

}  // namespace

ParticleSteps courant_steps_of_particles(const System<double>& system, double fraction) {
  require_courant(fraction, 2.0);
  ParticleSteps steps = steps_of(frequency_bounds(system), fraction);
  require_bounded(system);
  return steps;
}

ParticleSteps courant_steps_of_particles(const System<double>& system, const State<double>& state,
                                         double fraction) {
  require_courant(fraction, 2.0);
  return steps_of(frequency_bounds(system, state), fraction);
}

ParticleSteps without_resonance(const System<double>& system, ParticleSteps steps) {
  return nested_steps(system, frequency_bound(system), std::move(steps));
}

ParticleSteps without_resonance(const System<double>& system, const State<double>& state,
                                ParticleSteps steps) {
  return nested_steps(system, frequency_bound(system, state), std::move(steps));
}

}  // namespace jetlag
