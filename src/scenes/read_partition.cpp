// SPDX-License-Identifier: MIT
// Particles that a method treats in another way than the rest: "coarse", "implicit".
#include "jetlag/control/courant.hpp"
#include "jetlag/integrators/implicit/explicit_implicit.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

std::vector<bool> read_partition(const Value& list, const System<double>& system) {
  if (!list.is_array() || list.size() == 0) list.refuse("a list of at least one particle");
  std::vector<bool> chosen(system.particles(), false);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto particle = list.at(i).integer(0, system.particles() - 1);
    if (system.fixed()[particle]) list.at(i).refuse("a particle that is not fixed");
    if (chosen[particle]) list.at(i).refuse("a particle that is not in the list already");
    chosen[particle] = true;
  }
  return chosen;
}

std::vector<bool> read_implicit_particles(const Value& integrator, const System<double>& system,
                                          const State<double>& start, double step) {
  const Value implicit = integrator.at("implicit");
  if (!implicit.is_string()) return read_partition(implicit, system);
  if (implicit.text() != "courant") implicit.refuse("a list of particles, or \"courant\"");
  if (integrator.path() != "integrator")
    implicit.refuse("a list of particles inside another method, whose steps are not known beforehand");
  const auto beyond = checked(implicit, [&] { return beyond_courant(system, start, step); });
  if (frequency_bound(system, start) == 0)
    implicit.refuse("a list of particles: no force of this scene has a stiffness that limits the step");
  return beyond;
}

}  // namespace jetlag
