// SPDX-License-Identifier: MIT
// The paper's figures: points that spread about the exact motion, and energies that friction takes away.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

std::vector<std::vector<double>> numbers(const std::filesystem::path& csv) {
  std::istringstream lines(content(csv));
  std::string line, field;
  std::getline(lines, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream fields(line);
    while (std::getline(fields, field, ',')) rows.back().push_back(std::stod(field));
  }
  return rows;
}

class PaperFigures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    run = program("study paper_figures --members 8 --until 1 --out .", folder->path());
  }
  static void TearDownTestSuite() { delete folder; }
  static inline TemporaryFolder* folder = nullptr;
  static inline Ended run;
};

/// The mean of 8 members deviates by spread / sqrt(8) where the motion is still linear in the deviations, which it is at
/// the first of the times: a factor of 3 holds for the norm of 250 such points.
TEST_F(PaperFigures, PointsSpreadAboutTheExactMotion) {
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto rows = numbers(*folder / "figure1.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_GT(rows[0][1], 0.0);
  EXPECT_LT(rows[0][2], 3 * rows[0][1] / std::sqrt(8.0));
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_GT(rows[i][1], rows[i - 1][1]) << "spread grows";
}

/// Friction c takes energy away at a rate of at most 2 c (all of it kinetic) with unit masses, and within a second of at
/// least c / 2 of the slowest of these oscillations (half of it kinetic on average, k >= 5000).
TEST_F(PaperFigures, FrictionTakesEnergyAwayAtItsRate) {
  const auto weak = numbers(*folder / "figure3.csv");
  ASSERT_EQ(weak.size(), 241u);
  const double rate = -std::log(weak.back()[1]) / weak.back()[0];
  EXPECT_GT(rate, 0.5 * 3);
  EXPECT_LT(rate, 2.0 * 3);
}

/// Without friction the energy of (4,16,.5) at .003 s drifts by some per cent in 12 s (section 1d): within 1 s by less.
TEST_F(PaperFigures, RandomDegreesKeepTheEnergyAtASmallStep) {
  const auto rows = numbers(*folder / "figure2.csv");
  EXPECT_NEAR(rows.back()[1], 1.0, 0.05);
}

}  // namespace
}  // namespace jetlag::testing
