// SPDX-License-Identifier: MIT
// "integrator": {"type": "subcycling"}: a step for each particle.
#include <algorithm>

#include "jetlag/schedule/subcycling.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

const Range ratios{1, 1e9, true, true, "a number from 1 to 1e9"};

/// "step", "courant" of the fastest frequency, or the shorter one where both are given.
double read_short_step(const Value& control, const System<double>& system) {
  double step = control.has("step") ? control.at("step").number(positive) : infinite;
  if (const auto courant = read_courant(control, system))
    step = std::min(step, courant->first * 2.0 / courant->second);
  return step;
}

/// The longest step of a group that is within the limits of all its particles, and not shorter than those of the rest.
ParticleSteps within_limits(const std::vector<bool>& coarse, const ParticleSteps& limits, double step) {
  double longest = infinite;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    if (coarse[i]) longest = std::min(longest, limits[i]);
  ParticleSteps steps(coarse.size(), step);
  for (std::size_t i = 0; i < coarse.size(); ++i)
    if (coarse[i]) steps[i] = std::max(longest, step);
  return steps;
}

/// "ratio" to the short step: of the particles in "coarse", or a list with one for each particle; or "courant": what the
/// limits of the particles in "coarse" together, or of each particle for itself, allow.
ParticleSteps read_particle_steps(const Value& integrator, const Value& control,
                                  const System<double>& system) {
  const Value ratio = integrator.at("ratio");
  const auto listed = integrator.find("coarse");
  if (ratio.is_string()) {
    if (ratio.text() != "courant") ratio.refuse("a number, a list of one for each particle, or \"courant\"");
    const Value courant = control.at("courant");
    const double share = courant.number(fraction);
    const ParticleSteps limits = checked(courant, [&] { return courant_steps_of_particles(system, share); });
    if (listed)
      return within_limits(read_partition(*listed, system), limits, read_short_step(control, system));
    control.only({"type", "courant"});
    return limits;
  }
  const double step = read_short_step(control, system);
  const auto particles = static_cast<std::size_t>(system.particles());
  if (!listed) {
    if (!ratio.is_array())
      ratio.refuse("a list of one for each particle where integrator.coarse is left out");
    ParticleSteps steps = ratio.numbers(particles, ratios, "particle");
    for (double& of_particle : steps) of_particle *= step;
    return steps;
  }
  const std::vector<bool> coarse = read_partition(*listed, system);
  const double of_coarse = ratio.number(ratios) * step;
  ParticleSteps steps(particles, step);
  for (std::size_t i = 0; i < particles; ++i)
    if (coarse[i]) steps[i] = of_coarse;
  return steps;
}

}  // namespace

Method read_subcycling(const Value& scene, std::shared_ptr<const System<double>> system) {
  const Value integrator = scene.at("integrator");
  integrator.only({"type", "coarse", "ratio", "resonance"});
  const std::uint64_t max_steps = read_own_schedule(scene);
  ParticleSteps steps = read_particle_steps(integrator, read_own_control(scene), *system);
  checked(integrator.at("type"), [&] { Subcycling(*system, steps); });
  if (integrator.at("resonance", "allowed").one_of({"allowed", "avoided"}) == "avoided")
    steps = checked(integrator.at("resonance"), [&] { return without_resonance(*system, steps); });
  return impulse_method([system, steps] { return std::make_unique<Subcycling>(*system, steps); }, max_steps);
}

}  // namespace jetlag
