// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "studies/paper/struck_body.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace paper_table {  // batches compile studies together
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string mesh, csv;
  double step = 0.005, until = 12.0;
  std::uint64_t seed = 1;
  std::vector<int> only;  // numbers of rows; empty: all
};

struct Row {
  int min_degree;
  double friction;
  bool adaptive;
};

// The rows in the paper's order; max degree 6 and k = 5000 N/m in all of them.
constexpr Row rows[] = {{6, 1.0, true}, {3, 1.0, true}, {6, 1.0, false}, {3, 1.0, false},
                        {6, 0.2, true}, {3, 0.2, true}, {6, 0.2, false}, {3, 0.2, false}};

/// The body at rest, without gravity, struck: all velocities normal with deviation 1 m/s. The paper does not state its
/// step; 0.005 s is that of the assignment it began with.
Json scene_of(const Row& row, const Arguments& arguments) {
  Json control = {{"type", "fixed"}, {"step", arguments.step}};
  if (row.adaptive)
    control = {{"type", "halve_double"},
               {"step", arguments.step},
               {"max_step", arguments.step},
               {"min_variance", 1e-13},
               {"max_variance", 1e-8}};
  return {
      {"name", "paper table"},
      {"dimension", 3},
      {"particles", struck_body(arguments.mesh)},
      {"forces",
       {{{"type", "spring"}, {"pairs", "edges"}, {"stiffness", 5000.0}},
        {{"type", "drag"}, {"coefficient", row.friction}}}},
      {"integrator",
       {{"type", "random_taylor"}, {"min_degree", row.min_degree}, {"max_degree", 6}, {"probability", 0.5}}},
      {"control", control},
      {"until", arguments.until},
      {"seed", arguments.seed},
      {"output", {{"frames", 240}, {"pictures", false}}}};
}

int run_table(const Arguments& arguments) {
  std::vector<Scene> scenes;  // all are checked before the first is run
  for (const Row& row : rows)
    scenes.push_back(read_scene(scene_of(row, arguments).dump(), "paper table", "."));
  if (!arguments.csv.empty()) write_file(arguments.csv, "");
  std::printf("%s, step %g s, until t = %g s, k = 5000 N/m, max degree 6, p = 0.5\n",
              arguments.mesh.empty() ? "generated body" : arguments.mesh.c_str(), arguments.step,
              arguments.until);
  std::printf("%3s %4s %9s %9s  %-9s %-11s %8s %11s %11s %8s %9s %11s %8s\n", "row", "min", "friction",
              "adaptive", "verdict", "outcome", "at t [s]", "largest", "final", "steps", "mean deg.",
              "elem. coef.", "wall [s]");
  std::printf("%57s %11s %11s\n", "", "E/E0", "E/E0");
  std::string csv =
      "row,min_degree,max_degree,friction,adaptive,verdict,outcome,time,largest_energy_ratio,final_energy_"
      "ratio,steps,"
      "mean_degree,element_coefficients,wall_seconds\n";
  int number_of_row = 0;
  for (const Row& row : rows) {
    ++number_of_row;
    if (!arguments.only.empty() && std::ranges::count(arguments.only, number_of_row) == 0) continue;
    const RunResult result = run_scene(scenes[number_of_row - 1]);
    const Summary& summary = result.summary;
    const double initial = summary.initial_energy.total();
    double largest = 0;
    for (const EnergyRow& energy : result.energies)
      largest = std::max(largest, energy.energy.total() / initial);
    const double final_ratio = summary.final_energy.total() / initial;
    largest = std::max(largest, final_ratio);
    // Friction only takes energy away; randomness may add a little for a while, but not tenfold.
    const char* verdict = summary.outcome == Outcome::success && largest < 10 ? "bounded" : "blows up";
    const auto coefficients = static_cast<double>(summary.work.element_coefficients);
    std::printf("%3d %4d %9g %9s  %-9s %-11s %8.4g %11.4g %11.4g %8llu %9.3f %11.4g %8.2f\n", number_of_row,
                row.min_degree, row.friction, row.adaptive ? "yes" : "no", verdict,
                to_string(summary.outcome), summary.time, largest, final_ratio,
                static_cast<unsigned long long>(summary.work.steps), summary.work.mean_degree(), coefficients,
                summary.wall_seconds);
    std::fflush(stdout);
    csv += std::to_string(number_of_row) + "," + std::to_string(row.min_degree) + ",6," +
           number(row.friction) + "," + (row.adaptive ? "yes" : "no") + "," + verdict + "," +
           to_string(summary.outcome) + "," + number(summary.time) + "," + number(largest) + "," +
           number(final_ratio) + "," + std::to_string(summary.work.steps) + "," +
           number(summary.work.mean_degree()) + "," + std::to_string(summary.work.element_coefficients) +
           "," + number(summary.wall_seconds) + "\n";
  }
  if (!arguments.csv.empty()) write_file(arguments.csv, csv);
  return 0;
}

}  // namespace
}  // namespace paper_table

Command paper_table_study() {
  using namespace paper_table;
  return command<Arguments>("paper_table", "the paper's table of eight runs of a soft body, in numbers",
                            run_table, [](Arguments& a) -> std::vector<Option> {
                              return {{"--mesh", &a.mesh, "a Medit mesh in place of the generated body"},
                                      {"--step", &a.step, "first step [s]", Positive{}},
                                      {"--until", &a.until, "end of the runs [s]", Positive{}},
                                      {"--seed", &a.seed, "seed"},
                                      {"--rows", &a.only, "run only these rows (1 to 8)", Between{1, 8}},
                                      {"--csv", &a.csv, "also write the table to this file"}};
                            });
}

}  // namespace jetlag
