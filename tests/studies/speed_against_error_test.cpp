// SPDX-License-Identifier: MIT
// The study of speed against error: the orders of the methods are those of the theory, work is what it must be, and the
// files are complete.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "support/program.hpp"

namespace jetlag::testing::speed_against_error_test {
namespace {

using Table = std::vector<std::map<std::string, std::string>>;

/// A CSV with fields that may stand in quotation marks.
Table table(const std::string& text) {
  const auto fields = [](const std::string& line) {
    std::vector<std::string> all(1);
    bool inside = false;
    for (const char c : line) {
      if (c == '"')
        inside = !inside;
      else if (c == ',' && !inside)
        all.emplace_back();
      else
        all.back() += c;
    }
    return all;
  };
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto names = fields(line);
  Table rows;
  while (std::getline(lines, line)) {
    const auto values = fields(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i == 0) rows.emplace_back();
      rows.back()[names[i]] = values.at(i);
    }
  }
  return rows;
}

Table rows_of(const Table& all, const std::string& method) {
  Table chosen;
  for (const auto& row : all)
    if (row.at("method") == method) chosen.push_back(row);
  return chosen;
}

/// Steps 1.24, .62, ... .0775 over t = 496: error c h^N (1 + a h + ...). At the two shortest steps the quotient of two
/// errors is 2^N to some 10 %, which is .15 in the exponent; what is below 1e-14 is rounding.
TEST(SpeedAgainstError, FixedDegreesConvergeAtTheirOrderOnAChain) {
  const TemporaryFolder folder;
  const Ended run = program(
      "study speed_against_error --problem fput --family 'fixed degree' --steps 5 --out here", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const Table all = table(content(folder / "here/fput.csv"));
  for (int degree : {3, 4, 5, 6, 7}) {
    const Table rows = rows_of(all, "degree " + std::to_string(degree));
    ASSERT_EQ(rows.size(), 5u);
    const double coarse = std::stod(rows[3].at("position_error")),
                 fine = std::stod(rows[4].at("position_error"));
    EXPECT_NEAR(std::log2(coarse / fine), degree, 0.15 + 0.05 * degree) << degree;
  }
}

/// 33 springs, degree N: orders 0 .. N-1 of the forces at each of 496 / h steps.
TEST(SpeedAgainstError, WorkIsElementsTimesOrdersTimesSteps) {
  const TemporaryFolder folder;
  const Ended run = program(
      "study speed_against_error --problem fput --family 'fixed degree' --steps 3 --out .", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  for (int degree : {4, 10})
    for (const auto& row : rows_of(table(content(folder / "fput.csv")), "degree " + std::to_string(degree)))
      EXPECT_DOUBLE_EQ(std::stod(row.at("element_coefficients")),
                       33.0 * degree * std::round(496 / std::stod(row.at("step"))));
}

TEST(SpeedAgainstError, ASceneOfTheUserIsAProblemToo) {
  const TemporaryFolder folder;
  write(folder / "mine.json", R"({"name": "mine", "dimension": 1,
    "particles": {"position": [[0], [1.2]], "mass": 1, "fixed": [0]},
    "forces": [{"type": "spring", "pairs": [[0, 1]], "stiffness": 1, "rest_length": 1}],
    "integrator": {"type": "leapfrog"}, "control": {"type": "fixed", "step": 0.1}, "until": 6.0})");
  const Ended run = program(
      "study speed_against_error --scene mine.json --family 'fixed degree' --steps 2 --out .", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const Table rows = rows_of(table(content(folder / "mine.csv")), "degree 12");
  ASSERT_EQ(rows.size(), 2u);
  // cos t is left out by h^13 / 13! a step, h = .2: 4.3e-19 in each of 30 steps; what remains is rounding.
  EXPECT_LT(std::stod(rows[1].at("position_error")), 1e-14);
}

TEST(SpeedAgainstError, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  const Ended run = program("study speed_against_error --problem kepler2 --out here", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.output.find("kepler2"), std::string::npos) << run.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "here"));
}

}  // namespace
}  // namespace jetlag::testing::speed_against_error_test
