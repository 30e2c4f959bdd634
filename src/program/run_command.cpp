// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "command_line/interruption.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/tape/kernels.hpp"
#include "program/commands.hpp"
#include "program/scene_arguments.hpp"

namespace jetlag {

namespace {

struct RunArguments {
  SceneArguments scene;
  std::filesystem::path folder;
  bool quiet = false;
};

void print_result(const Summary& summary, const std::filesystem::path& folder) {
  std::printf("%s: %s at t = %.10g s, %llu steps, mean degree %.3g, %.3g s\n",
              shown_name(folder.string()).c_str(), to_string(summary.outcome), summary.time,
              static_cast<unsigned long long>(summary.work.steps), summary.work.mean_degree(),
              summary.wall_seconds);
  if (summary.has_energy)
    std::printf("  energy   %.10g J -> %.10g J, largest relative change %.3g\n",
                summary.initial_energy.total(), summary.final_energy.total(),
                summary.max_relative_energy_error);
  for (const auto& file : first_files_of_run(folder))
    std::printf("  %-12s %s%s\n", "", shown_name(file.string()).c_str(),
                file.extension() == ".pvd" ? "   (ParaView)" : "");
}

int run(const RunArguments& arguments) {
  const Scene scene = arguments.scene.load();
  kernels<double>();  // a wrong JETLAG_INSTRUCTION_SET is bad input: said before anything is written
  const std::filesystem::path folder =
      arguments.folder.empty() ? std::filesystem::path("out") / arguments.scene.stem() : arguments.folder;
  stop_in_good_order();
  RunHooks hooks;
  std::vector<std::string> warnings;
  RunResult result;
  {
    ProgressLine line(arguments.quiet);
    hooks.after_step = [&](const Progress& progress) {
      line.show(progress.time, progress.until, progress.steps, "steps");
      return !stop_requested();
    };
    result = run_scene_into(scene, folder, hooks, warnings);
  }
  if (!arguments.quiet) print_result(result.summary, folder);
  warnings.insert(warnings.begin(), result.summary.warnings.begin(), result.summary.warnings.end());
  for (const std::string& warning : warnings) std::fprintf(stderr, "jetlag: %s\n", warning.c_str());
  if (result.summary.outcome == Outcome::success) return 0;
  std::fprintf(stderr, "jetlag: %s: %s\n", to_string(result.summary.outcome), result.summary.message.c_str());
  return not_finished;
}

}  // namespace

Command run_command() {
  return command<RunArguments>(
      "run", "run a scene and leave its results in a folder", run, [](RunArguments& a) {
        return a.scene.options({{"--out", &a.folder, "folder for the results (default: out/SCENE)"},
                                {"--quiet", &a.quiet, "no progress, no report"}});
      });
}

}  // namespace jetlag
