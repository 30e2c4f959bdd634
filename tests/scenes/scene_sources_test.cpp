// SPDX-License-Identifier: MIT
// Where a scene may come from: a file, a pipe, standard input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string jetlag = "'" JETLAG_PROGRAM "'", short_run = " --set until=0.5 --quiet --out out";

/// A run that must succeed; its last positions.
Json positions(const std::string& arguments) {
  const TemporaryFolder folder;
  const Ended run = program(arguments, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return Json::parse(content(folder / "out/summary.json"))["position"];
}

TEST(SceneSource, MayBeStandardInputOrAPipe) {
  const Json truth = positions("run chain" + short_run);
  const std::string show = "show chain | " + jetlag + " run ";
  EXPECT_EQ(positions(show + "-" + short_run), truth);
  EXPECT_EQ(positions(show + "/dev/stdin" + short_run), truth);
  EXPECT_EQ(positions("run <(" + jetlag + " show chain)" + short_run), truth);
  EXPECT_EQ(positions("--version && mkfifo pipe && { " + jetlag + " show chain > pipe & " + jetlag +
                      " run pipe" + short_run + "; }"),
            truth);
  EXPECT_EQ(positions("show chain > file && " + jetlag + " run -" + short_run + " < file"), truth);
}

TEST(SceneSource, OfStandardInputHasAFolderForItsResults) {
  const TemporaryFolder folder;
  const Ended run = program(
      "show chain | " + jetlag + " run - --quiet --set until=0.1 --set output.pictures=false", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/stdin/summary.json"));
}

TEST(SceneSource, IsRefusedWhereThereIsNothingToRead) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Ended run = program(arguments, folder.path());
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("scene: got"), HasSubstr(why), HasSubstr("a JSON file that can be read")));
  };
  ASSERT_EQ(std::system(("mkfifo " + (folder / "pipe").string()).c_str()), 0);
  refused("run pipe", "a pipe that nobody writes to");
  refused("run .", "is a folder");
  refused("run /dev/null", "neither a file nor a pipe");
  refused("run - < .", "Is a directory");
  refused("run /proc/self/mem", "Input/output error");
  refused("run " + std::string(300, 'a'), "File name too long");
  refused("run $'two\\nlines'", "two\\nlines");
  EXPECT_EQ(program("run - < /dev/null", folder.path()).exit_code, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "something was written";
}

}  // namespace
}  // namespace jetlag::testing
