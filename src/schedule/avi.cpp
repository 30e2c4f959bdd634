// SPDX-License-Identifier: MIT
#include "jetlag/schedule/avi.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "jetlag/integrators/accelerations.hpp"

namespace jetlag {

namespace {

void require_potential(const RecordedLaw& law) {
  const char* why = reads(law, Input::Kind::velocity) ? "its force depends on velocities"
                    : reads(law, Input::Kind::time)   ? "its force depends on time"
                    : !law.energy                     ? "its force is not the gradient of a potential energy"
                                                      : nullptr;
  if (why)
    throw std::invalid_argument("avi integrates forces with a potential energy in the positions only; " +
                                law.name + " is none: " + why + "; leave it out or take another integrator");
}

void require_steps(const System<double>& system, const ElementSteps& steps) {
  const auto& groups = system.elements();
  if (steps.size() != groups.size())
    throw std::invalid_argument("avi: steps are needed for each of " + std::to_string(groups.size()) +
                                " groups of elements, got " + std::to_string(steps.size()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (steps[g].size() != groups[g].count())
      throw std::invalid_argument("avi: a step is needed for each of " + std::to_string(groups[g].count()) +
                                  " elements of " + groups[g].law.name + ", got " +
                                  std::to_string(steps[g].size()));
    for (const double step : steps[g]) require_positive("step", step);
  }
}

/// The particles of some elements that are not fixed, ascending.
std::vector<int> moving_ends(const System<double>& system, const std::vector<std::vector<int>>& members) {
  std::vector<int> found;
  for (std::size_t g = 0; g < members.size(); ++g) {
    const auto& group = system.elements()[g];
    const int p = group.law.participants;
    for (const int e : members[g])
      for (int i = 0; i < p; ++i)
        if (const int particle = group.particles[e * p + i]; !system.fixed()[particle])
          found.push_back(particle);
  }
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  found.erase(repeated.begin(), repeated.end());
  return found;
}

}  // namespace

void require_potentials(const System<double>& system) {
  for (const auto& group : system.elements())
    if (group.count() > 0) require_potential(group.law);
}

Avi::Avi(const System<double>& system, const ElementSteps& steps) : Impulses(system, "avi", "element") {
  require_potentials(system);
  require_steps(system, steps);
  std::map<double, std::vector<std::vector<int>>> members;  // of each step, group by group
  for (std::size_t g = 0; g < steps.size(); ++g)
    for (std::size_t e = 0; e < steps[g].size(); ++e) {
      auto& groups = members[steps[g][e]];
      groups.resize(steps.size());
      groups[g].push_back(static_cast<int>(e));
    }
  for (const auto& [step, groups] : members) add_clock(step, groups, moving_ends(system, groups));
}

}  // namespace jetlag
