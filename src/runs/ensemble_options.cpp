// SPDX-License-Identifier: MIT
#include "runs/ensemble_options.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/scenes/error.hpp"
#include "runs/ensemble_statistics.hpp"

namespace jetlag {

const SeriesMethod& series_of(const Scene& scene, const EnsembleOptions& options) {
  if (!scene.series)
    throw SceneError("integrator.type: an ensemble is made of random_taylor, or with --perturb of taylor");
  if (known_beforehand(scene.series->law).is_fixed() && options.perturbation == 0)
    throw SceneError(
        "integrator: its degree is fixed, so all members would be the same; must be random_taylor with "
        "max_degree > min_degree, or take --perturb SIGMA for members that start apart");
  return *scene.series;
}

void check(const Scene& scene, const EnsembleOptions& options) {
  if (options.members < 1 || options.members > 1'000'000)
    throw SceneError("--members: got " + std::to_string(options.members) +
                     "; must be a whole number from 1 to 1000000");
  if (options.threads < 1 || options.threads > 1024)
    throw SceneError("--threads: got " + std::to_string(options.threads) +
                     "; must be a whole number from 1 to 1024");
  if (!(options.perturbation >= 0) || !std::isfinite(options.perturbation))
    throw SceneError("--perturb: got " + number(options.perturbation) + "; must be a finite number >= 0");
  series_of(scene, options);
  if (moving_particles(*scene.system) == 0)
    throw SceneError("particles.fixed: all particles are fixed; an ensemble needs one that moves");
  const double bytes = bytes_needed(scene, options);
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > 0.8 * memory)
    throw SceneError("--members: " + std::to_string(options.members) + " members and " +
                     std::to_string(scene.output.frames) + " frames would take " + number(bytes / 1e9) +
                     " GB; must be below 80 % of the memory of this machine, " + number(memory / 1e9) +
                     " GB");
}

double bytes_needed(const Scene& scene, const EnsembleOptions& options) {
  constexpr double in_a_sample = sizeof(Sample) + sizeof(double),
                   in_the_table = 2 * 260;  // text, as it grows
  const auto quantities = static_cast<double>(quantities_of(scene, options.velocities).size());
  const double of_a_member = RandomEnsemble::bytes_of_a_member(*scene.system, series_of(scene, options));
  return options.members * (of_a_member + quantities * sizeof(double)) +
         std::max(1, scene.output.frames) * quantities * (in_a_sample + in_the_table);
}

}  // namespace jetlag
