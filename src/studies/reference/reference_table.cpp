// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "jetlag/base/stopwatch.hpp"
#include "problems/reference_values.hpp"
#include "studies/reference/reference_problems.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace reference_table {  // batches compile studies together
namespace {

struct Arguments {
  int degree = 20;
};

int run_table(const Arguments& arguments) {
  const int degree = arguments.degree;
  std::printf("Taylor's method of degree %d, steps of Jorba and Zou; error: largest of the end values\n",
              degree);
  std::printf("%-47s %8s %12s %7s %9s  %s\n", "problem", "until", "outcome", "steps", "error", "wall [s]");
  for (const ReferenceProblem& problem : reference_problems()) {
    const Stopwatch watch;
    const ReferenceSolution solution = problem.solve(degree, {});
    const double seconds = watch.seconds();
    const auto& values = problems::reference_values().at(problem.name);
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
}  // namespace reference_table

Command reference_problems_study() {
  using namespace reference_table;
  return command<Arguments>("reference_problems",
                            "problems with known end values, and what is missed of them", run_table,
                            [](Arguments& a) -> std::vector<Option> {
                              return {{"--degree", &a.degree, "degree of the series", Between{2, 60}}};
                            });
}

}  // namespace jetlag
