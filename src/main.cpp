// SPDX-License-Identifier: MIT
// The program: jetlag run | ensemble | scenes | show | check | methods | study | stability.
//
// Exit codes: 0 success; 1 a file or folder cannot be written; 2 bad input, nothing is written; 3 the run did not reach its end.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"
#include "jetlag/version.hpp"
#include "studies/command_line.hpp"
#include "studies/ensemble_command.hpp"
#include "studies/methods_command.hpp"
#include "studies/studies.hpp"

namespace {

using namespace jetlag;

void print_result(const Summary& summary, const std::filesystem::path& folder) {
  std::printf("%s: %s at t = %.10g s, %llu steps, mean degree %.3g, %.3g s\n", folder.string().c_str(),
              to_string(summary.outcome), summary.time, static_cast<unsigned long long>(summary.work.steps),
              summary.work.mean_degree(), summary.wall_seconds);
  if (summary.has_energy)
    std::printf("  energy   %.10g J -> %.10g J, largest relative change %.3g\n",
                summary.initial_energy.total(), summary.final_energy.total(),
                summary.max_relative_energy_error);
  for (const auto& file : first_files_of_run(folder))
    std::printf("  %-12s %s%s\n", "", file.c_str(), file.extension() == ".pvd" ? "   (ParaView)" : "");
}

int run(const SceneArguments& arguments, std::filesystem::path folder, bool quiet) {
  const Scene scene = arguments.load();
  kernels<double>();  // a wrong JETLAG_INSTRUCTION_SET is bad input: said before anything is written
  if (folder.empty()) folder = std::filesystem::path("out") / std::filesystem::path(arguments.scene).stem();
  stop_in_good_order();
  RunHooks hooks;
  std::vector<std::string> warnings;
  RunResult result;
  {
    ProgressLine line(quiet);
    hooks.after_step = [&](const Progress& progress) {
      line.show(progress.time, progress.until, progress.steps, "steps");
      return !stop_requested();
    };
    result = run_scene_into(scene, folder, hooks, warnings);
  }
  if (!quiet) print_result(result.summary, folder);
  warnings.insert(warnings.begin(), result.summary.warnings.begin(), result.summary.warnings.end());
  for (const std::string& warning : warnings) std::fprintf(stderr, "jetlag: %s\n", warning.c_str());
  if (result.summary.outcome == Outcome::success) return 0;
  std::fprintf(stderr, "jetlag: %s: %s\n", to_string(result.summary.outcome), result.summary.message.c_str());
  return not_finished;
}

void list_scenes() {
  for (const auto& scene : built_in_scenes())
    std::printf("%-10s %s\n", scene.name.c_str(), scene.description.c_str());
}

/// What a scene is and what its run would cost, from one expansion measured here.
void check(const SceneArguments& arguments) {
  const Scene scene = arguments.load();
  const System<double>& system = *scene.system;
  std::size_t elements = 0;
  for (const auto& group : system.elements()) elements += group.count();
  std::printf("%s: valid\n", scene.name.c_str());
  std::printf("  particles   %d in %d dimension%s, %d fixed\n", system.particles(), system.dimension(),
              system.dimension() == 1 ? "" : "s", system.particles() - moving_particles(system));
  for (const auto& group : system.elements())
    std::printf("  force       %-14s %zu element%s\n", group.law.name.c_str(), group.count(),
                group.count() == 1 ? "" : "s");
  if (const double omega = frequency_bound(system); omega > 0)
    std::printf("  stiffness   frequencies up to %.4g rad/s; leapfrog is stable below a step of %.4g s\n",
                omega, 2 / omega);
  const int orders = std::max(1, static_cast<int>(scene.mean_orders + 0.5));
  Expansion<double> series(system, orders + 1);
  series.start(scene.initial);
  series.grow_to(orders + 1);
  int repeats = 0;
  const Stopwatch watch;
  double elapsed = 0;
  do {
    series.start(scene.initial);
    series.grow_to(orders + 1);
    ++repeats;
    elapsed = watch.seconds();
  } while (elapsed < 0.05);
  std::printf("  memory      %.3g MB of series\n", static_cast<double>(series.bytes()) / 1e6);
  const char* about = scene.orders_at_least ? "at least" : "about";
  std::printf("  a step      %s%.4g orders on average, %.3g element coefficients, %s %.3g ms\n",
              scene.orders_at_least ? "at least " : "", scene.mean_orders,
              scene.mean_orders * static_cast<double>(elements), about, 1e3 * elapsed / repeats);
  if (const double steps = scene.fixed_step ? std::ceil(scene.until / *scene.fixed_step) : 0; steps > 0)
    std::printf("  the run     %.*g steps, %s %.2g s and the frames\n", steps < 1e15 ? 15 : 4, steps, about,
                scene.until / *scene.fixed_step * elapsed / repeats);
  else
    std::printf("  the run     as many steps as its control chooses, until t = %.6g s\n", scene.until);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("jetlag: mechanical scenes in time, by Taylor series stopped at a random order");
  app.set_version_flag("--version", std::string("jetlag ") + version);
  app.require_subcommand(1);

  SceneArguments scene;
  std::filesystem::path folder;
  bool quiet = false;
  auto* run_command = app.add_subcommand("run", "run a scene and leave its results in a folder");
  scene.add_to(*run_command);
  add_out(*run_command, folder, "folder for the results (default: out/SCENE)");
  run_command->add_flag("--quiet", quiet, "no progress, no report");
  auto* scenes_command = app.add_subcommand("scenes", "list the built-in scenes");
  auto* show_command = app.add_subcommand("show", "print a scene as JSON, complete");
  scene.add_to(*show_command);
  auto* check_command = app.add_subcommand("check", "validate a scene and say what its run would cost");
  scene.add_to(*check_command);
  std::optional<Study> study;
  add_ensemble(app, study);
  add_methods(app, study);
  add_studies(app, study);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  try {
    int code = 0;
    if (*run_command) code = run(scene, folder, quiet);
    if (*scenes_command) list_scenes();
    if (*show_command) std::printf("%s\n", scene.load().json.c_str());
    if (*check_command) check(scene);
    if (study) code = (*study)();
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw std::runtime_error("cannot write to standard output");
    return code;
  } catch (const SceneError& error) {
    std::fprintf(stderr, "jetlag: %s\n", error.what());
    return bad_input;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "jetlag: %s\n", error.what());
    return bad_input;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "jetlag: cannot write %s: %s; give another folder, or make room or rights there\n",
                 error.path1().c_str(), error.code().message().c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "jetlag: %s\n", error.what());
    return 1;
  }
}
