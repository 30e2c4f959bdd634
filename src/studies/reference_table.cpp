// SPDX-License-Identifier: MIT
#include "studies/reference_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "jetlag/base/stopwatch.hpp"
#include "studies/reference_problems.hpp"

namespace jetlag {

namespace {

int run_table(int degree) {
  std::printf("Taylor's method of degree %d, steps of Jorba and Zou; error: largest of the end values\n",
              degree);
  std::printf("%-47s %8s %12s %7s %9s  %s\n", "problem", "until", "outcome", "steps", "error", "wall [s]");
  for (const ReferenceProblem& problem : reference_problems()) {
    const Stopwatch watch;
    const ReferenceSolution solution = problem.solve(degree, {});
    const double seconds = watch.seconds();
    const auto& values = reference_values().at(problem.name);
    double error = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      error = std::max(error, static_cast<double>(std::abs(solution.end[i] - std::stold(values[i]))));
    std::printf("%-47s %8.6g %12s %7llu %9.2g  %.2g\n", problem.name.c_str(), problem.until,
                to_string(solution.report.outcome), static_cast<unsigned long long>(solution.steps), error,
                seconds);
  }
  return 0;
}

}  // namespace

void add_reference_table(CLI::App& study, std::optional<Study>& chosen) {
  auto* command = study.add_subcommand("reference_problems",
                                       "problems with known end values, and what is missed of them");
  auto degree = std::make_shared<int>(20);
  command->add_option("--degree", *degree, "degree of the series")
      ->check(CLI::Range(2, 60))
      ->capture_default_str();
  command->callback([&chosen, degree] { chosen = [degree] { return run_table(*degree); }; });
}

}  // namespace jetlag
