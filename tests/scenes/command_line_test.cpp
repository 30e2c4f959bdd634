// SPDX-License-Identifier: MIT
// What the program does with its command line, with signals, and with folders that it cannot write.
#include <gmock/gmock.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, RefusesPathsWithEmptyParts) {
  const TemporaryFolder folder;
  for (const char* path :
       {"control..step", ".control.step", "control.step.", "forces[].stiffness", "forces[0]..type"}) {
    const Ended run = program("run chain --out out --set " + std::string(path) + "=3", folder.path());
    EXPECT_EQ(run.exit_code, 2) << path;
    EXPECT_THAT(run.output, AllOf(HasSubstr("--set"), HasSubstr(path), HasSubstr("empty"))) << path;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CommandLine, RefusesAFolderWithoutAName) {
  const TemporaryFolder folder;
  for (const char* command : {"run chain --out ''", "ensemble ellipse --members 2 --out ''"}) {
    const Ended run = program(command, folder.path());
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, AllOf(HasSubstr("--out"), HasSubstr("name of a folder")));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CommandLine, CountsStepsInDigitsOneCanRead) {
  const TemporaryFolder folder;
  const auto steps = [&](const std::string& until) {
    return program("check chain --set control.step=0.5 --set until=" + until, folder.path()).output;
  };
  EXPECT_THAT(steps("1e300"), HasSubstr(" 2e+300 steps"));
  EXPECT_THAT(steps("1e10"), HasSubstr(" 20000000000 steps"));
}

TEST(CommandLine, NamesAFolderThatCannotBeMadeAndWhy) {
  const TemporaryFolder folder;
  write(folder / "file", "");  // a folder cannot lie in a file, whoever asks
  const Ended run = program("run chain --out file/out", folder.path());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("cannot write file/out"), HasSubstr("Not a directory"),
                                Not(HasSubstr("filesystem error"))));
}

TEST(CommandLine, QuotesNamesThatWouldBreakALine) {
  const TemporaryFolder folder;
  const Ended run =
      program("run chain --set until=0.1 --set output.pictures=false --out $'a\\nb\\xff'", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr(R"("a\nb\xff": success)"), HasSubstr(R"("a\nb\xff/summary.json")"),
                                Not(HasSubstr("a\nb"))));
  const Ended ensemble =
      program("ensemble ellipse --members 2 --set until=0.01 --set output.pictures=false --out $'c\\nd'",
              folder.path());
  EXPECT_THAT(ensemble.output, AllOf(HasSubstr(R"("c\nd": success)"), Not(HasSubstr("c\nd"))));
  write(folder / "file", "");
  const Ended refused = program("run chain --out $'file/\\n'", folder.path());
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output, HasSubstr(R"("file/\n": Not a directory)"));
}

TEST(CommandLine, BecomesTheProgramOfTheStudies) {
  const TemporaryFolder folder;
  EXPECT_THAT(program("study --help", folder.path()).output, HasSubstr("Usage: jetlag study"));
  const Ended refused = program("study ruler --steps 0", folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("--steps"));
}

TEST(CommandLine, SaysHowToBuildTheStudiesWhereThereAreNone) {
  const TemporaryFolder folder;
  const Ended alone =
      program("--version && cp '" JETLAG_PROGRAM "' jetlag && ./jetlag study kepler 2>&1", folder.path());
  EXPECT_EQ(alone.exit_code, 1);
  EXPECT_THAT(alone.output,
              AllOf(HasSubstr("jetlag-study: No such file"), HasSubstr("./run study"), HasSubstr("CMake")));
}

class Signal : public ::testing::TestWithParam<const char*> {};

TEST_P(Signal, EndsARunInGoodOrder) {
  const TemporaryFolder folder;
  // The folder is made after the handler is in place; the shell waits for it, and not for ever.
  const Ended run = program("--version && { '" JETLAG_PROGRAM
                            "' run two_body --out out --quiet --set until=1e12 & p=$!; "
                            "for i in {1..1000}; do [ -e out/scene.json ] && break; sleep 0.01; done; "
                            "kill -" +
                                std::string(GetParam()) + " $p; wait $p; }",
                            folder.path());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  const Json summary = Json::parse(content(folder / "out/summary.json"));
  EXPECT_EQ(summary["outcome"], "interrupted");
  EXPECT_THAT(summary["message"].get<std::string>(),
              AllOf(HasSubstr("stopped at t = "), HasSubstr("the outputs hold the run up to there")));
}

INSTANTIATE_TEST_SUITE_P(CommandLine, Signal, ::testing::Values("TERM", "HUP"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace jetlag::testing
