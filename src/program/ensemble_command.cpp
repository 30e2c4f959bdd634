// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "command_line/interruption.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/runs/run_ensemble.hpp"
#include "jetlag/tape/kernels.hpp"
#include "program/commands.hpp"
#include "program/scene_arguments.hpp"

namespace jetlag {

namespace {

struct EnsembleArguments {
  SceneArguments scene;
  EnsembleOptions options;
  std::filesystem::path folder;
  bool quiet = false;
};

void print(const EnsembleResult& result, const std::filesystem::path& folder) {
  const EnsembleFrame& last = result.frames.back();
  std::printf(
      "%s: %s at t = %.10g s, %zu of %zu members, %llu steps, mean degree %.3g, %.3g s, %d thread%s%s\n",
      shown_name(folder.string()).c_str(), to_string(result.outcome), last.time, last.members, result.members,
      static_cast<unsigned long long>(result.work.steps), result.work.mean_degree(), result.wall_seconds,
      result.threads, result.threads == 1 ? "" : "s", result.in_lanes ? ", in lanes" : "");
  const Calibration c = over_time(result);
  const auto row = [&](const char* what, double value, bool comparable = true) {
    std::printf("  %-34s", what);
    if (std::isfinite(value))
      std::printf("%10.3g m", value);
    else
      std::printf("%10s", "not known");
    if (comparable && value != c.spread && value > 0 && c.spread > 0)
      std::printf("   spread / it %8.3g", c.spread / value);
    std::printf("\n");
  };
  row("spread of the members", c.spread);
  row("true error of the members", c.member_error);
  row("true error of their mean", c.mean_error);
  row(("true error of fixed degree " + std::to_string(result.deterministic_degree)).c_str(),
      c.deterministic_error, result.perturbation == 0);  // else the spread is that of where the members start
  std::printf("  (root mean squares over the positions of all moving particles at all frames)\n");
  for (const char* name : ensemble_files)
    if (std::filesystem::exists(folder / name))
      std::printf("  %s\n", shown_name((folder / name).string()).c_str());
}

int run(const EnsembleArguments& arguments) {
  const Scene scene = arguments.scene.load();
  kernels<double>();  // a wrong JETLAG_INSTRUCTION_SET is bad input: said before anything is written
  std::filesystem::path folder = arguments.folder;
  if (folder.empty()) folder = std::filesystem::path("out") / (arguments.scene.stem() + "_ensemble");
  stop_in_good_order();
  std::vector<std::string> warnings = scene.warnings;
  EnsembleResult result;
  {
    ProgressLine line(arguments.quiet);
    EnsembleHooks hooks;
    hooks.go_on = [] { return !stop_requested(); };
    hooks.after_frame = [&](double time, double until) {
      line.show(time, until, static_cast<std::uint64_t>(arguments.options.members), "members");
    };
    result = run_ensemble_into(scene, arguments.options, folder, hooks, warnings);
  }
  if (!arguments.quiet) print(result, folder);
  if (!result.reference_message.empty()) warnings.push_back("the reference " + result.reference_message);
  if (!result.deterministic_message.empty())
    warnings.push_back("the run of fixed degree " + std::to_string(result.deterministic_degree) + ' ' +
                       result.deterministic_message);
  if (!result.warning.empty())
    warnings.push_back("the run of fixed degree " + std::to_string(result.deterministic_degree) + ": " +
                       result.warning);
  if (result.outcome == Outcome::success && !result.failures.empty())
    warnings.push_back(std::to_string(result.failures.size()) + " of " + std::to_string(result.members) +
                       " members failed and are left out from then on; the first: " +
                       result.failures.front().report.message);
  for (const std::string& warning : warnings) std::fprintf(stderr, "jetlag: %s\n", warning.c_str());
  if (result.outcome == Outcome::success) return 0;
  std::fprintf(stderr, "jetlag: %s: %s\n", to_string(result.outcome), result.message.c_str());
  return not_finished;
}

}  // namespace

Command ensemble_command() {
  EnsembleArguments defaults;
  defaults.options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return command<EnsembleArguments>(
      "ensemble", "run many members of a scene and say how they spread", run,
      [](EnsembleArguments& a) {
        return a.scene.options(
            {{"--members", &a.options.members, "number of members"},
             {"--threads", &a.options.threads, "threads; the result does not depend on their number"},
             {"--watch", &a.options.watch, "what the picture shows: PARTICLE or PARTICLE.COMPONENT, 17.y"},
             {"--perturb", &a.options.perturbation, "standard deviation of the initial positions [m]"},
             {"--velocities", &a.options.velocities, "velocities in ensemble.csv too"},
             {"--out", &a.folder, "folder for the results (default: out/SCENE_ensemble)"},
             {"--quiet", &a.quiet, "no progress, no report"}});
      },
      defaults);
}

}  // namespace jetlag
