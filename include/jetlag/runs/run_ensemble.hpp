// SPDX-License-Identifier: MIT
#pragma once
// Running a scene many times at once: an ensemble.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/output/ensemble_table.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

struct EnsembleOptions {
  int members = 1000;
  int threads = 1;  // the result does not depend on their number
  double perturbation =
      0;  // [m], standard deviation of normal numbers added to the initial positions of moving particles
  bool velocities = false;  // whether velocities are quantities too
  std::string
      watch;  // PARTICLE or PARTICLE.COMPONENT (x, y, z): what the picture shows; empty: what spreads most
};

struct EnsembleHooks {
  std::function<bool()> go_on;  // asked now and then, by any thread; false ends the run
  std::function<void(double time, double until)> after_frame;  // [s]
};

/// Runs the members of a scene from frame to frame and keeps what they amount to at each, on the polynomials of the
/// motion: nothing else is kept. Member i draws with member_seed(scene.seed, i). Beside them runs the
/// reference, and after them, where they were not stopped, the run of a fixed degree that Calibration speaks of.
/// A member that fails is left out from then on; the ensemble fails when all have.
/// Throws SceneError naming the option or the key: a scene whose members would all be the same, an integrator that is not a
/// series, a number out of range, what does not exist or does not fit into memory.
EnsembleResult run_ensemble(const Scene& scene, const EnsembleOptions& options,
                            const EnsembleHooks& hooks = {});

/// The memory that takes, by and large [bytes]: members, what they amount to at each frame, and the table of it.
/// Throws SceneError as above for a scene that makes no ensemble.
double bytes_needed(const Scene& scene, const EnsembleOptions& options);

/// What an ensemble leaves in a folder, first what to look at first; ensemble.svg where gnuplot is there.
inline constexpr const char* ensemble_files[] = {"ensemble.json", "ensemble.csv", "ensemble.svg",
                                                 "scene.json"};

/// As run_ensemble, and leaves these files in `folder`. What an earlier run or ensemble left there under such names goes
/// before anything is written; ensemble.csv grows with the frames. What is under a name is whole and of this ensemble, and
/// the folder is held, as by run_scene_into. warnings: what could not be drawn.
/// Throws std::runtime_error naming a file or folder that cannot be written.
EnsembleResult run_ensemble_into(const Scene& scene, const EnsembleOptions& options,
                                 const std::filesystem::path& folder, const EnsembleHooks& hooks,
                                 std::vector<std::string>& warnings);

}  // namespace jetlag
