// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/parts.hpp"
#include "studies/comparison/competitors.hpp"
#include "studies/comparison/test_problems.hpp"
#include "studies/comparison/work_precision_chart.hpp"
#include "studies/studies.hpp"

namespace jetlag {

using problems::Problem;

namespace speed_against_error {  // batches compile studies together
namespace {

struct Arguments {
  std::vector<std::string> problems, scenes, families;
  std::filesystem::path folder = "out/speed_against_error";
  int seeds = 4, steps = 5;
  double limit = 20;  // [s]
};

/// All runs of one method at one step.
struct Row {
  std::string family, method;
  bool is_taylor = true;
  double step = 0;  // [s]; 0: chosen by the method
  int seeds = 0, failed = 0;
  bool slow = false;                                 // stopped at the limit
  double position_error = 0, energy_error = 0;       // root mean square over seeds; NaN where there is none
  double element_coefficients = 0, mean_degree = 0;  // mean over seeds
  double seconds = 0;  // processor time of one thread: mean over seeds of the least of three runs
};

constexpr double longest_repeated = 0.05;  // [s]: longer runs are warm after their first steps

/// step: filled in where the method has one.
Row run(const Problem& problem, const Competitor& competitor, double step, int seeds, double limit) {
  Row row{competitor.family, competitor.name, competitor.is_taylor, competitor.has_step ? step : 0.0};
  Json json = {{"integrator", competitor.integrator}, {"control", competitor.control}};
  if (competitor.has_step) json["control"]["step"] = step;
  if (!competitor.schedule.is_null()) json["schedule"] = competitor.schedule;
  EnergyMeter energy(problem.system);
  const auto system = std::make_shared<const System<double>>(problem.system);
  const double initial = energy(problem.start).total();
  double squares = 0, energy_squares = 0;
  for (int seed = 1; seed <= (competitor.random ? seeds : 1); ++seed) {
    Json copy = json;
    const Value scene(copy, "");
    scene.only({"integrator", "control", "schedule"});
    const Method method = read_method(scene, system, problem.start, static_cast<std::uint64_t>(seed));
    const auto schedule = method.schedule();
    State<double> state = problem.start;
    const double start = processor_seconds();
    RunOptions options;
    int calls = 0;
    options.observer.after_step = [&](const StepView&) {
      return ++calls % 64 != 0 || processor_seconds() - start < limit;
    };
    const Report report = schedule->run(state, problem.until, options);
    double seconds = processor_seconds() - start;
    for (int repeat = 0; repeat < 2 && seconds < longest_repeated; ++repeat) {
      const auto again = method.schedule();
      State<double> same = problem.start;
      const double begin = processor_seconds();
      again->run(same, problem.until, {});
      seconds = std::min(seconds, processor_seconds() - begin);
    }
    ++row.seeds;
    row.slow = row.slow || report.outcome == Outcome::interrupted;
    if (report.outcome != Outcome::success) {
      ++row.failed;
      if (row.slow) break;
      continue;
    }
    const double error = problems::distance(problem.system, state.position, *problem.end),
                 energy_error = energy(state).total() / initial - 1;
    squares += error * error;
    energy_squares += energy_error * energy_error;
    row.element_coefficients += static_cast<double>(schedule->work().element_coefficients);
    row.mean_degree += schedule->work().mean_degree();
    row.seconds += seconds;
  }
  const double good = row.seeds - row.failed, none = std::numeric_limits<double>::quiet_NaN();
  row.position_error = row.failed == 0 ? std::sqrt(squares / good) : none;
  row.energy_error =
      row.failed == 0 && problems::conserves_energy(problem.system) ? std::sqrt(energy_squares / good) : none;
  row.element_coefficients /= good;
  row.mean_degree /= good;
  row.seconds /= good;
  return row;
}

std::string shown(double value, const char* format = "{:.2e}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

void print(const Row& row) {
  fmt::print("{:<22} {:<30} {:>10} {:>11} {:>11} {:>12} {:>9} {:>7}{}\n", row.family, row.method,
             row.step > 0 ? shown(row.step, "{:.4g}") : "chosen", shown(row.position_error),
             shown(row.energy_error), shown(row.element_coefficients, "{:.4g}"), shown(row.seconds, "{:.3g}"),
             shown(row.mean_degree, "{:.2f}"),
             row.slow         ? std::string("   too slow")
             : row.failed > 0 ? fmt::format("   {} of {} runs failed", row.failed, row.seeds)
                              : std::string());
  std::fflush(stdout);
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string csv =
      "family,method,step,seeds,failed,position_error,energy_error,element_coefficients,seconds,mean_"
      "degree\n";
  for (const Row& row : rows)
    csv += row.family + ",\"" + row.method + "\"," + field(row.step) + ',' + std::to_string(row.seeds) + ',' +
           std::to_string(row.failed) + ',' + field(row.position_error) + ',' + field(row.energy_error) +
           ',' + field(row.element_coefficients) + ',' + field(row.seconds) + ',' + field(row.mean_degree) +
           '\n';
  return csv;
}

/// The least work of each family for errors up to some, over all its methods and steps.
void print_least_work(const std::vector<Row>& rows, double floor) {
  std::vector<std::string> families;
  for (const Row& row : rows)
    if (std::ranges::find(families, row.family) == families.end()) families.push_back(row.family);
  std::vector<double> targets;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Row& row : rows)
    if (std::isfinite(row.position_error)) {
      least = std::min(least, row.position_error);
      most = std::max(most, row.position_error);
    }
  for (double target = 1; target > std::max(least, floor) && targets.size() < 7; target /= 100)
    if (target < most) targets.push_back(target);
  fmt::print("\nleast element coefficients for a position error of at most ...\n{:<22}", "");
  for (double target : targets) fmt::print(" {:>10.0e}", target);
  fmt::print("\n");
  for (const std::string& family : families) {
    fmt::print("{:<22}", family);
    for (double target : targets) {
      double work = std::numeric_limits<double>::infinity();
      for (const Row& row : rows)
        if (row.family == family && row.position_error <= target)
          work = std::min(work, row.element_coefficients);
      fmt::print(" {:>10}", shown(work, "{:.3g}"));
    }
    fmt::print("\n");
  }
}

/// How far the motion reaches: the largest distance of a particle from the first one, at the end and at the beginning, and
/// from where it began.
double extent(const Problem& problem) {
  double most = 0;
  for (int i = 0; i < problem.system.particles(); ++i)
    for (const auto* x : {&*problem.end, &problem.start.position})
      most = std::max(
          {most, (x->row(i) - x->row(0)).norm(), (x->row(i) - problem.start.position.row(i)).norm()});
  return most > 0 ? most : 1.0;
}

void draw(const std::filesystem::path& picture, const Problem& problem,
          const std::vector<WorkPrecision>& points) {
  try {
    draw_work_precision(picture, problem.description, points, problem.end_error, extent(problem));
    fmt::print("{}\n", picture.string());
  } catch (const std::runtime_error& error) {  // no run has an error that can be drawn
    fmt::print("no picture: {}\n", error.what());
  }
}

void compare(const Problem& problem, const Arguments& arguments, const std::vector<Competitor>& all) {
  fmt::print("\n{}: {}\nreference to {:.1e} m; errors are root mean squares over particles and {} seeds\n\n",
             problem.name, problem.description, problem.end_error, arguments.seeds);
  fmt::print("{:<22} {:<30} {:>10} {:>11} {:>11} {:>12} {:>9} {:>7}\n", "family", "method", "step [s]",
             "error [m]", "energy", "elem. coef.", "CPU [s]", "degree");
  std::vector<Row> rows;
  for (const Competitor& competitor : all)
    for (int i = 0; i < (competitor.has_step ? arguments.steps : 1); ++i) try {
        rows.push_back(
            run(problem, competitor, std::ldexp(problem.largest_step, -i), arguments.seeds, arguments.limit));
        print(rows.back());
      } catch (const SceneError& error) {  // not every method can do every problem, or every step
        fmt::print("{:<22} {:<30} {}\n", competitor.family, competitor.name, error.what());
      }
  print_least_work(rows, 10 * problem.end_error);
  write_file(arguments.folder / (problem.name + ".csv"), csv_of(rows));
  fmt::print("\n{}\n", (arguments.folder / (problem.name + ".csv")).string());
  if (!can_draw()) {
    fmt::print("gnuplot is not in PATH: no picture\n");
    return;
  }
  // One picture of Taylor's methods, with all others as one; one of the others, with the main ones of Taylor.
  std::vector<WorkPrecision> taylor, methods;
  for (const Row& row : rows) {
    if (!(row.position_error > 0 && std::isfinite(row.position_error))) continue;
    const WorkPrecision point{row.family, row.position_error, row.element_coefficients, row.seconds};
    taylor.push_back(point);
    if (!row.is_taylor) taylor.back().family = "other methods";
    if (!row.is_taylor ||
        std::ranges::count(std::array{"fixed degree", "ruler", "jorba_zou", "block", "asynchronous"},
                           row.family))
      methods.push_back(point);
  }
  draw(arguments.folder / (problem.name + ".svg"), problem, taylor);
  draw(arguments.folder / (problem.name + "_methods.svg"), problem, methods);
}

int run_study(const Arguments& arguments) {
  std::vector<Competitor> chosen;
  for (Competitor& competitor : competitors())
    if (arguments.families.empty() || std::ranges::count(arguments.families, competitor.family) > 0)
      chosen.push_back(std::move(competitor));
  std::vector<Problem> scenes;  // all are checked before the first is run
  for (const std::string& name : arguments.scenes) {
    const Scene scene = load_scene(name);
    if (moving_particles(*scene.system) == 0)
      throw SceneError("--scene: got " + name + "; must have a particle that moves");
    scenes.push_back(problem_of(scene));
    scenes.back().name = std::filesystem::path(name).stem().string();  // as the folder of a run
    if (std::ranges::count(scenes, scenes.back().name, &Problem::name) > 1)
      throw SceneError("--scene: got two scenes with the name " + scenes.back().name + "; must differ");
  }
  const ResultFolder held(arguments.folder);
  for (const Problem& problem : scenes) compare(problem, arguments, chosen);
  for (const auto& entry : test_problems()) {
    const bool named = std::ranges::count(arguments.problems, entry.name) > 0;
    if (!named && !(arguments.problems.empty() && scenes.empty())) continue;
    Problem problem = entry.make();
    problem.name = entry.name;
    problem.description = entry.description;
    compare(problem, arguments, chosen);
  }
  return 0;
}

std::vector<std::string> names_of_problems() {
  std::vector<std::string> names;
  for (const auto& entry : test_problems()) names.push_back(entry.name);
  return names;
}

std::vector<std::string> names_of_families() {
  std::vector<std::string> names;
  for (const Competitor& competitor : competitors())
    if (std::ranges::find(names, competitor.family) == names.end()) names.push_back(competitor.family);
  return names;
}

}  // namespace
}  // namespace speed_against_error

Command speed_against_error_study() {
  using namespace speed_against_error;
  return command<Arguments>(
      "speed_against_error", "work against error of all methods, as tables, CSV and pictures", run_study,
      [](Arguments& a) -> std::vector<Option> {
        return {{"--problem", &a.problems, "only these problems", names_of_problems()},
                {"--scene", &a.scenes, "a built-in scene or a JSON file; its own method is not used"},
                {"--family", &a.families, "only these families of methods", names_of_families()},
                {"--seeds", &a.seeds, "runs of each random method", Between{1, 1000}},
                {"--steps", &a.steps, "step lengths, each half of the one before", Between{1, 20}},
                {"--limit", &a.limit, "processor time after which a run is stopped [s]", Positive{}},
                {"--out", &a.folder, "folder for tables and pictures"}};
      });
}

}  // namespace jetlag
