// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "jetlag/base/text.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/scenes/error.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace ruler_table {  // batches compile studies together
namespace {

struct Arguments {
  double eccentricity = 0.3, steps = 118.3719;  // steps a period
  int periods = 1000, seeds = 16, max_degree = 16;
};

struct Row {
  std::string name;
  TruncationLaw law;
  Draw draws = Draw::independent;
};

/// Fixed degrees, and about degree 6 the draws.
std::vector<Row> rows(int n) {
  std::vector<Row> rows;
  for (int degree : {6, 7, 8}) rows.push_back({"fixed " + std::to_string(degree), fixed_degree(degree)});
  const double golden = std::numbers::phi - 1;
  const auto add = [&](const std::string& name, double p, Draw draws) {
    rows.push_back({"(6, " + std::to_string(n) + ") " + name, geometric(6, n, p), draws});
  };
  add("p = .5, independent", 0.5, Draw::independent);
  add("p = .5, antithetic", 0.5, Draw::antithetic);
  add("1-p = phi^-2, rotation", golden, Draw::rotation);
  add("1-p = phi^-4, rotation", 1 - std::pow(golden, 4), Draw::rotation);
  for (int base : {2, 3, 5, 7, 11}) add("ruler " + std::to_string(base), 1 - 1.0 / base, Draw::ruler);
  for (int base : {2, 5})
    add("scrambled ruler " + std::to_string(base), 1 - 1.0 / base, Draw::scrambled_ruler);
  std::vector<double> mixed(n + 1, 1.0);
  const int bases[] = {7, 11, 13, 17};
  for (int i = 7; i <= n; ++i) mixed[i] = mixed[i - 1] / bases[(i - 7) % 4];
  rows.push_back({"(6, " + std::to_string(n) + ") ruler 7, 11, 13, 17", {"mixed", mixed}, Draw::ruler});
  return rows;
}

/// The place at time t of a planet that was in the pericentre at 0.         Source: Kepler's equation, by Newton's
/// rule.
Eigen::RowVector2d place(double e, double t) {
  const double mean = std::remainder(t, 2 * std::numbers::pi);
  double anomaly = mean;
  for (int i = 0; i < 50; ++i)
    anomaly -= (anomaly - e * std::sin(anomaly) - mean) / (1 - e * std::cos(anomaly));
  return {std::cos(anomaly) - e, std::sqrt((1 - e) * (1 + e)) * std::sin(anomaly)};
}

/// Root mean squares over the seeds of the relative energy error, at the end and over that at half time, and of the
/// position error; coefficients of the element a step.
void run_row(const Row& row, const Arguments& arguments) {
  const double e = arguments.eccentricity, h = 2 * std::numbers::pi / arguments.steps;
  const auto steps = static_cast<std::uint64_t>(std::llround(arguments.steps * arguments.periods));
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{1.0}});
  EnergyMeter energy(system);
  const int seeds = row.law.is_fixed() ? 1 : arguments.seeds;
  double at_half = 0, at_end = 0, position = 0, coefficients = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    State<double> state{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
    state.position(1, 0) = 1 - e;
    state.velocity(1, 1) = std::sqrt((1 + e) / (1 - e));
    RandomTaylor::Options options;
    options.seed = seed;
    options.velocity = VelocitySeries::derivative;
    options.draws = row.draws;
    RandomTaylor method(system, row.law, std::make_unique<FixedStep>(h), options);
    Report report;
    const auto squared_error = [&] { return std::pow(2 * energy(state).total() + 1, 2) / seeds; };
    for (std::uint64_t n = 0; n < steps; ++n) {
      if (n == steps / 2) at_half += squared_error();
      if (method.step(state, h, report) == 0.0) {
        std::printf("%-34s %s\n", row.name.c_str(), report.message.c_str());
        return;
      }
    }
    at_end += squared_error();
    position += (state.position.row(1) - place(e, static_cast<double>(steps) * h)).squaredNorm() / seeds;
    coefficients +=
        static_cast<double>(method.work().element_coefficients) / static_cast<double>(steps) / seeds;
  }
  std::printf("%-34s %12.3f %12.2g %10.2f %12.2g\n", row.name.c_str(), coefficients, std::sqrt(at_end),
              std::sqrt(at_end / at_half), std::sqrt(position));
  std::fflush(stdout);
}

int run_it(const Arguments& arguments) {
  if (std::isnan(arguments.eccentricity))
    throw SceneError("--eccentricity: got nan; must be a number from 0 to 0.9");
  if (!(arguments.steps * arguments.periods >= 2))  // growth is that from half of the time to all of it
    throw SceneError("--steps: got " + number(arguments.steps) +
                     "; must be a number of at least 1, 2 in all periods");
  std::printf(
      "planet, e = %g, %g steps a period, %d periods, RMS of %d seeds, velocities by the derivative\n",
      arguments.eccentricity, arguments.steps, arguments.periods, arguments.seeds);
  std::printf("%-34s %12s %12s %10s %12s\n", "", "coefficients", "energy", "growth", "position");
  for (const Row& row : rows(arguments.max_degree)) run_row(row, arguments);
  return 0;
}

}  // namespace
}  // namespace ruler_table

Command ruler_study() {
  using namespace ruler_table;
  return command<Arguments>("ruler", "errors of a planet with fixed and random degrees, by kind of draw",
                            run_it, [](Arguments& a) -> std::vector<Option> {
                              return {{"--eccentricity", &a.eccentricity, "of the orbit", Between{0, 0.9}},
                                      {"--steps", &a.steps, "steps a period", Between{1, 1e6}},
                                      {"--periods", &a.periods, "length of the runs", Between{1, 1'000'000}},
                                      {"--seeds", &a.seeds, "number of runs", Between{1, 10'000}}};
                            });
}

}  // namespace jetlag
