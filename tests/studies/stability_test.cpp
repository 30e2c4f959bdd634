// SPDX-License-Identifier: MIT
// `jetlag stability` as a user calls it.
#include <gmock/gmock.h>

#include <cstdlib>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(StabilityCommand, PrintsThePublishedLimitsAndLeavesAMap) {
  const TemporaryFolder folder;
  const Ended run = program("stability --min 3 --max 6 --probability .5 --out map", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("3.553441"), HasSubstr("2.271943524"), HasSubstr("map/stability.csv")));
  const std::string csv = content(folder / "map/stability.csv");
  EXPECT_THAT(csv, HasSubstr("real,imaginary,mean,mean_square,almost_sure\n"));
  EXPECT_THAT(csv, HasSubstr("\n0,0,0,0,0\n"));  // R_K(0) = 1
  if (std::filesystem::exists(folder / "map/stability.svg"))
    EXPECT_THAT(content(folder / "map/stability.svg"), AllOf(HasSubstr("mean square"), HasSubstr("</svg>")));
  else
    EXPECT_THAT(run.output, HasSubstr("gnuplot is not in PATH"));
}

TEST(StabilityCommand, PrintsItsTableWithoutGnuplot) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::create_symlink("/bin/bash", folder / "bin/bash");  // which runs the program
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder / "bin").c_str(), 1);
  const Ended run = program("stability --min 3 --max 4 --velocity derivative", folder.path());
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("no damping"), HasSubstr("not known"), HasSubstr("out/stability"),
                                HasSubstr("gnuplot is not in PATH")));
}

/// A tail may be any law: here that of (3,6,.5).
TEST(StabilityCommand, TakesATailOfOnesOwn) {
  const TemporaryFolder folder;
  const Ended run = program("stability --law tail --tail 1,1,1,1,.5,.25,.125 --out here", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("degrees 3 to 6"), HasSubstr("2.271943524")));
}

TEST(StabilityCommand, SaysWhatIsWrongWithWhichOption) {
  const TemporaryFolder folder;
  struct Bad {
    const char *arguments, *option, *value, *allowed;
  };
  for (const Bad& bad : {Bad{"--min 0", "--min", "0", "1"},
                         {"--min x", "--min", "x", "256"},
                         {"--min 4 --max 3", "--max", "3", "--min = 4"},
                         {"--max 257", "--max", "257", "256"},
                         {"--probability 1", "--probability", "1", "below 1"},
                         {"--probability 2", "--probability", "2", "1"},
                         {"--probability nan", "--probability", "nan", "0 to 1"},
                         {"--law fair", "--law", "fair", "geometric"},
                         {"--law poisson --mean 0", "--mean", "0", "> 0"},
                         {"--law tail --tail 1,.5,.7", "--tail", "0.7", "not be larger"},
                         {"--law tail", "--tail", "", "P(K >= 0)"},
                         {"--velocity none", "--velocity", "none", "own_series"}}) {
    const Ended run = program(std::string("stability ") + bad.arguments, folder.path());
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, AllOf(HasSubstr(bad.option), HasSubstr(bad.value), HasSubstr(bad.allowed)));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace jetlag::testing
