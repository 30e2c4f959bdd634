// SPDX-License-Identifier: MIT
// The program: jetlag run | scenes | show | check | study | stability.
//
// Exit codes: 0 success; 1 a file cannot be written; 2 bad input, nothing is written; 3 the run did not reach its end.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>

#include "jetlag/control/courant.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/run_scene.hpp"
#include "jetlag/scenes/scene.hpp"
#include "jetlag/version.hpp"
#include "studies/studies.hpp"

namespace {

using namespace jetlag;

std::atomic<bool> stop_requested = false;
extern "C" void request_stop(int) { stop_requested = true; }

/// The first Ctrl-C lets a run end in good order, the second ends the program.
void stop_in_good_order() {
  struct sigaction action{};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

constexpr int bad_input = 2, not_finished = 3;

struct SceneArguments {
  std::string scene;
  std::vector<std::string> settings;
  std::string seed;

  void add_to(CLI::App& command) {
    command.add_option("scene", scene, "a built-in scene or a JSON file")->required();
    command.add_option("--set", settings, "replace a value: key.path=value, may be repeated")
        ->allow_extra_args(false);
    command.add_option("--seed", seed, "seed of the random numbers");
  }
  Scene load() const {
    if (seed.empty()) return load_scene(scene, settings);
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), number);
    if (error != std::errc() || end != seed.data() + seed.size())
      throw SceneError("--seed: got " + seed + "; must be a whole number from 0 to 18446744073709551615");
    return load_scene(scene, settings, number);
  }
};

/// A line that says how far a run is and how long it will still take: renewed in place on a terminal, now and then a
/// new one in a log.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet)
      : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}

  void show(const Progress& progress) {
    const auto now = Clock::now();
    if (quiet_ || now - last_ < std::chrono::milliseconds(terminal_ ? 100 : 3000)) return;
    last_ = now;
    shown_ = true;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double done = progress.time / progress.until;
    std::fprintf(stderr, "%s%5.1f %%   t = %.4g s of %.4g s   %llu steps   %.3g s left   %s",
                 terminal_ ? "\r" : "", 100 * done, progress.time, progress.until,
                 static_cast<unsigned long long>(progress.steps), elapsed / done - elapsed,
                 terminal_ ? "" : "\n");
  }
  ~ProgressLine() {
    if (shown_ && terminal_) std::fprintf(stderr, "\r%*s\r", 78, "");
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, shown_ = false;
  Clock::time_point start_, last_;
};

void print_result(const Summary& summary, const std::filesystem::path& folder) {
  std::printf("%s: %s at t = %.10g s, %llu steps, mean degree %.3g, %.3g s\n", folder.string().c_str(),
              to_string(summary.outcome), summary.time, static_cast<unsigned long long>(summary.work.steps),
              summary.work.mean_degree(), summary.wall_seconds);
  if (summary.has_energy)
    std::printf("  energy   %.10g J -> %.10g J, largest relative change %.3g\n",
                summary.initial_energy.total(), summary.final_energy.total(),
                summary.max_relative_energy_error);
  for (const char* name : {"summary.json", "scene.json", "energy.csv", "energy.svg", "film.png"})
    if (std::filesystem::exists(folder / name))
      std::printf("  %-12s %s\n", "", (folder / name).string().c_str());
  std::printf("  %-12s %s   (ParaView)\n", "", (folder / "frames" / "run.pvd").string().c_str());
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
      line.show(progress);
      return !stop_requested;
    };
    result = run_scene_into(scene, folder, hooks, warnings);
  }
  if (!quiet) print_result(result.summary, folder);
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
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0;
  do {
    series.start(scene.initial);
    series.grow_to(orders + 1);
    ++repeats;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } while (elapsed < 0.05);
  std::printf("  memory      %.3g MB of series\n", static_cast<double>(series.bytes()) / 1e6);
  std::printf("  a step      %.4g orders on average, %.3g element coefficients, about %.3g ms\n",
              scene.mean_orders, scene.mean_orders * static_cast<double>(elements), 1e3 * elapsed / repeats);
  if (scene.fixed_step)
    std::printf("  the run     %.0f steps, about %.2g s and the frames\n",
                std::ceil(scene.until / *scene.fixed_step),
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
  run_command->add_option("--out", folder, "folder for the results (default: out/SCENE)");
  run_command->add_flag("--quiet", quiet, "no progress, no report");
  auto* scenes_command = app.add_subcommand("scenes", "list the built-in scenes");
  auto* show_command = app.add_subcommand("show", "print a scene as JSON, complete");
  scene.add_to(*show_command);
  auto* check_command = app.add_subcommand("check", "validate a scene and say what its run would cost");
  scene.add_to(*check_command);
  std::optional<Study> study;
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
  } catch (const std::exception& error) {
    std::fprintf(stderr, "jetlag: %s\n", error.what());
    return 1;
  }
}
