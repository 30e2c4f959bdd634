// SPDX-License-Identifier: MIT
// A step for each particle.
#include "jetlag/schedule/subcycling.hpp"

#include "scenes/methods/clocks/impulses.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

const Range ratios{1, 1e9, true, true, "a number from 1 to 1e9"};

/// "step", "courant" of the fastest frequency, or the shorter one where both are given.
double read_short_step(const Value& control, const System<double>& system, const State<double>& start) {
  double step = control.has("step") ? control.at("step").number(positive) : infinite;
  if (const auto courant = read_courant(control, system, start))
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
ParticleSteps read_particle_steps(const Value& integrator, const Value& control, const System<double>& system,
                                  const State<double>& start) {
  const Value ratio = integrator.at("ratio");
  const auto listed = integrator.find("coarse");
  if (ratio.is_string()) {
    if (ratio.text() != "courant") ratio.refuse("a number, a list of one for each particle, or \"courant\"");
    const Value courant = control.at("courant");
    const double share = courant.number(fraction);
    const ParticleSteps limits =
        checked(courant, [&] { return courant_steps_of_particles(system, start, share); });
    if (listed)
      return within_limits(read_partition(*listed, system), limits, read_short_step(control, system, start));
    control.only({"type", "courant"});
    return limits;
  }
  const double step = read_short_step(control, system, start);
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

Method read_subcycling(const ScheduleArguments& arguments) {
  const auto& [scene, integrator, schedule, system, seed, threads, start] = arguments;
  ParticleSteps steps = read_particle_steps(integrator, require_steps(scene), *system, start);
  checked(integrator.at("type"), [&] { Subcycling(*system, steps); });
  if (avoids_resonance(integrator))
    steps = checked(integrator.at("resonance"), [&] { return without_resonance(*system, start, steps); });
  return impulse_method([system = system, steps] { return std::make_unique<Subcycling>(*system, steps); });
}

}  // namespace

MethodRecord subcycling() {
  return {
      .name = "subcycling",
      .what = "Leapfrog with a step for each particle, in whole ratios or any other",
      .when =
          "A stiff part of a scene that should not dictate the steps of the rest, to some digits, and "
          "forces without a potential (not of velocities); with `resonance` avoided. With a potential "
          "take `avi`.",
      .declared = {{"schedule/subcycling.hpp", "Subcycling"}, {"schedule/impulses.hpp", "Impulses"}},
      .keys = joined(
          {{{"integrator.coarse", "a list of particles that are not fixed", "none"},
            {"integrator.ratio",
             "of long steps to the short one, 1 to 1e9: of the particles in `coarse`, or without it a list "
             "of one for each; or `courant`: what the limits of those in `coarse`, or of each, allow",
             "required"},
            {"control.step", "the short step [s], > 0", "none; step, courant or both: the shorter"},
            {"control.courant",
             "the fraction of the limit of the fastest frequency, or of each particle, > 0 and <= 1",
             "none; step, courant or both: the shorter"}},
           own_clocks}),
      .examples = {R"({"integrator": {"type": "subcycling", "coarse": [4, 5, 6, 7], "ratio": 2.5},
 "control": {"step": 0.01}})",
                   R"({"integrator": {"type": "subcycling", "ratio": "courant", "resonance": "avoided"},
 "control": {"courant": 0.2}})"},
      .proofs = {{"0.1268403737",
                  "the step where the chain wall-100-A-1-B-1-wall with the ratio 4 begins to resonate, in "
                  "75-digit arithmetic; the band ends at 0.1276082943",
                  "SubcyclingResonance.HasTheBandOfTheChainWithRatioFour",
                  "schedule/subcycling/subcycling_resonance_test.cpp"},
                 {"1.018873", "spectral radius at h = 0.17975 for the ratio 5/2",
                  "SubcyclingResonance.HasBandsForRealRatios",
                  "schedule/subcycling/subcycling_resonance_test.cpp"},
                 {"1e-13",
                  "no farther is it from the scheme of 1979, which the test writes down, in 1000 steps of "
                  "whole ratios",
                  "Subcycling.IsTheSchemeOf1979WhereRatiosAreWhole",
                  "schedule/subcycling/subcycling_test.cpp"}},
      .own_schedule = read_subcycling};
}

}  // namespace jetlag::methods
