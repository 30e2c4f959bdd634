// SPDX-License-Identifier: MIT
// `jetlag methods`: the list, a page, all pages in a folder.
#include <gmock/gmock.h>

#include "scenes/methods/methods.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using ::testing::HasSubstr;

TEST(MethodsCommand, ListsAllAndPrintsEach) {
  const TemporaryFolder folder;
  const Ended list = program("methods", folder.path());
  EXPECT_EQ(list.exit_code, 0);
  for (const MethodRecord& page : method_records()) EXPECT_THAT(list.output, HasSubstr(page.name + " "));
  EXPECT_EQ(program("methods leapfrog", folder.path()).output, markdown(method_record("leapfrog")));
}

TEST(MethodsCommand, WritesAPageForEachAndAnIndex) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("methods --out docs/methods", folder.path()).exit_code, 0);
  const std::string index = content(folder / "docs/methods/index.md");
  for (const MethodRecord& page : method_records()) {
    EXPECT_EQ(content(folder / ("docs/methods/" + page.name + ".md")), markdown(page));
    EXPECT_THAT(index, HasSubstr("[" + page.name + "](" + page.name + ".md)"));
  }
}

TEST(MethodsCommand, SaysWhichMethodsExistWhereANameDoesNot) {
  const TemporaryFolder folder;
  const Ended ended = program("methods frogleap", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("\"frogleap\""));
  for (const MethodRecord& page : method_records()) EXPECT_THAT(ended.output, HasSubstr(page.name));
  EXPECT_EQ(program("methods leapfrog --out docs", folder.path()).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "docs"));
}

}  // namespace
}  // namespace jetlag::testing
