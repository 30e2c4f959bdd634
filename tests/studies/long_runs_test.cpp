// SPDX-License-Identifier: MIT
// The studies of long runs print what the tests of long runs hold: steps a period, errors that rounding explains, an energy
// that does not drift.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace jetlag::testing::long_runs_test {
namespace {

/// The lines that a study prints, cut into words.
std::vector<std::vector<std::string>> table(const std::string& study) {
  const TemporaryFolder folder;
  const Ended run = program("study " + study, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  std::istringstream lines(run.output);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    rows.emplace_back();
    for (std::string word; in >> word;) rows.back().push_back(word);
  }
  return rows;
}

TEST(KeplerStudy, TellsStepsAndErrors) {
  const auto rows = table("kepler --periods 5 --runs 2");
  ASSERT_EQ(rows.size(), 3u + 6u);
  const int steps[] = {74, 120, 166};
  // Errors over 1000 periods, of which those over 5 are a fourteenth or, with luck, up to 4 times that: a third.
  const double errors[] = {2e-13, 2e-12, 2e-11};
  for (int i = 0; i < 6; ++i) {
    const auto& row = rows[3 + i];  // e, sums, steps, first error, rms, largest, position
    ASSERT_EQ(row.size(), 7u);
    EXPECT_EQ(row[0], i % 3 == 0 ? "0.9" : i % 3 == 1 ? "0.99" : "0.999");
    EXPECT_EQ(row[1], i < 3 ? "plain" : "compensated");
    EXPECT_LE(std::stod(row[2]), steps[i % 3] + 1.0);  // the last step of 5 periods is a short one
    EXPECT_LE(std::stod(row[5]), errors[i % 3] / 3);
    EXPECT_GT(std::stod(row[4]), 0.0);
    EXPECT_LE(std::stod(row[4]), std::stod(row[5]));
    EXPECT_LE(std::stod(row[6]), 1e-6);
  }
}

TEST(BrouwerStudy, TellsHowErrorsGrow) {
  const auto rows = table("brouwer --periods 20 --runs 2");
  ASSERT_EQ(rows.size(), 2u + 5u + 1u);
  const char* periods[] = {"1", "2", "5", "10", "20"};
  for (int i = 0; i < 5; ++i) {
    const auto& row = rows[2 + i];  // periods, rms, mean, steps
    ASSERT_EQ(row.size(), 4u);
    EXPECT_EQ(row[0], periods[i]);
    // A rounding of the energy is 1e-16 of it; 40 steps a period, 20 periods: 30 of them at random.
    EXPECT_LE(std::stod(row[1]), 1e-14);
    EXPECT_NEAR(std::stod(row[3]), 35.0, 1.0);
  }
  EXPECT_EQ(rows[7][0] + " " + rows[7][1], "the rms");
}

TEST(AviDriftStudy, HasAnEnergyThatDoesNotDrift) {
  // fraction, times, largest error, first tenth, last tenth, their ratio, momentum, impulses
  const auto rows = table("avi_drift --fractions 0.1");
  ASSERT_EQ(rows.size(), 4u);
  const auto& row = rows[3];
  ASSERT_EQ(row.size(), 8u);
  EXPECT_LT(std::stod(row[2]),
            0.03);  // 0.01887 up to 2000 s (tests/schedule/avi/avi_test.cpp), 50 times as many times
  EXPECT_NEAR(std::stod(row[5]), 1.0, 0.1);
  // Impulses on two particles are opposite to the last bit and masses are 1. What remains are roundings of velocities
  // of 0.06 to 0.25, of 4e-18 to 8e-18 rms, in 2 x 3.2e7 updates of a random walk: 3e-14 to 6e-14.
  EXPECT_LT(std::stod(row[6]), 1e-13);
}

TEST(MassRatioStudy, TellsUpdatesAndEnergies) {
  // degree, method in one or three words, updates of heavy and light, ratio, coefficients, energy errors, end
  const auto rows = table("mass_ratio --degrees 8 --periods 1000");
  ASSERT_EQ(rows.size(), 3u + 4u);
  const double ratios[] = {8, 2, 1, 1};  // a free clock waits for the light mass
  for (int i = 0; i < 4; ++i) {
    const auto& row = rows[3 + i];
    ASSERT_GE(row.size(), 9u);
    const auto last = [&](int n) { return std::stod(row[row.size() - n]); };
    EXPECT_NEAR(last(5), ratios[i], 0.01);
    EXPECT_LE(last(3), last(2));
    // Steps that are good to the tolerance of 1e-10 m, in the sum too: the light mass swings, and errors with it.
    EXPECT_LT(last(1), 1e-9);
    EXPECT_LT(last(2), 1e-9);
  }
}

}  // namespace
}  // namespace jetlag::testing::long_runs_test
