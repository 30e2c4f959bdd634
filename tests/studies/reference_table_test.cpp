// SPDX-License-Identifier: MIT
// The table of reference problems: a line for each, with an error that shrinks as the degree grows.
#include <gtest/gtest.h>

#include <sstream>

#include "problems/reference_values.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

/// The column `error` of the table, problem by problem.
std::map<std::string, double> errors(const std::string& arguments) {
  const TemporaryFolder folder;
  const Ended run = program("study reference_problems " + arguments, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  std::istringstream lines(run.output);
  std::map<std::string, double> found;
  for (std::string line; std::getline(lines, line);)
    for (const auto& [name, values] : problems::reference_values())
      if (line.starts_with(name + " ")) {
        std::istringstream fields(line.substr(name.size()));
        std::string until, outcome, steps;
        fields >> until >> outcome >> steps >> found[name];
        EXPECT_EQ(outcome, "success") << line;
      }
  return found;
}

TEST(ReferenceTable, HasAllProblemsAndSmallerErrorsForALargerDegree) {
  const auto coarse = errors("--degree 6"), fine = errors("");
  ASSERT_EQ(fine.size(), problems::reference_values().size());
  for (const auto& [name, error] : fine) {
    EXPECT_LT(error, 1e-9) << name;  // the worst have 8e-11: their conditioning, not the method
    EXPECT_LT(error, 1e-3 * coarse.at(name))
        << name;  // exp(-12) a step is left out at degree 6, exp(-40) at 20
  }
}

}  // namespace
}  // namespace jetlag::testing
