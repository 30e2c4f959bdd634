// SPDX-License-Identifier: MIT
#pragma once
// Running a scene, with or without leaving files behind.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/output/clock_table.hpp"
#include "jetlag/output/energy_table.hpp"
#include "jetlag/output/shape.hpp"
#include "jetlag/output/summary.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

struct Progress {
  double time, until;  // [s]
  std::uint64_t steps;
};

struct RunHooks {
  std::function<void(const Frame&)>
      frame;  // at time 0 and at each of scene.output.frames times; of 0 at the end
  std::function<bool(const Progress&)> after_step;  // false ends the run as `interrupted`
};

struct RunResult {
  Summary summary;
  std::vector<EnergyRow> energies;   // one for each frame, when the scene asks for the energy
  std::optional<ClockTable> clocks;  // when the scene asks for them
};

/// Runs a scene from its initial state. The energy is measured at the frames, on the polynomials of the motion, and at
/// the last good state of a run that ends early; max_relative_error is the largest of these. It is relative to the
/// initial energy, or where that is 0 to the largest kinetic energy so far.
RunResult run_scene(const Scene& scene, const RunHooks& hooks = {});

/// As above, and leaves in `folder` what the outputs write that the scene asks for: summary.json, scene.json,
/// frames/run.pvd with a .vtu for each frame, energy.csv, clocks.csv, and where gnuplot is there energy.svg, clocks.svg
/// and film.png. What an earlier run or ensemble left there under such names goes before anything is written.
///
/// What is under a name is whole and of this run at any moment, also where the process is killed: run.pvd and the tables
/// grow with the frames (of many, they are some 3 % behind), summary.json and the pictures come last, and a draft that is
/// left goes at the next run there. While this one runs, another one into the same folder is refused.
/// warnings: what could not be drawn. Throws std::runtime_error naming a file or folder that cannot be written.
RunResult run_scene_into(const Scene& scene, const std::filesystem::path& folder, const RunHooks& hooks,
                         std::vector<std::string>& warnings);

/// What there is of it, the first file of each output: those to look at.
std::vector<std::filesystem::path> first_files_of_run(const std::filesystem::path& folder);

}  // namespace jetlag
