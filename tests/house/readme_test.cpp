// SPDX-License-Identifier: MIT
// What the README shows is what is compiled and what the program says.
#include <gtest/gtest.h>

#include <regex>

#include "jetlag/scenes/scene.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

const std::filesystem::path source = JETLAG_SOURCE_DIR;

/// The lines between two marks.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto from = text.find(begin), to = text.find(end, from + begin.size());
  EXPECT_NE(from, std::string::npos) << begin;
  EXPECT_NE(to, std::string::npos) << end;
  return text.substr(from + begin.size(), to - from - begin.size());
}

TEST(Readme, ExampleIsTheOneThatIsCompiled) {
  const std::string example =
      between(content(source / "tests/consumer/main.cpp"), "// [readme]\n", "// [readme end]");
  EXPECT_NE(content(source / "README.md").find("```cpp\n" + example + "```"), std::string::npos);
}

TEST(Readme, NamesOnlyFilesThatExist) {
  const std::string readme = content(source / "README.md");
  const std::regex link(R"(\]\(([^)#:]+)\))");
  int links = 0;
  for (std::sregex_iterator match(readme.begin(), readme.end(), link), none; match != none; ++match, ++links)
    EXPECT_TRUE(std::filesystem::exists(source / (*match)[1].str())) << (*match)[1];
  EXPECT_GT(links, 0);
}

TEST(Readme, NamesEveryBuiltInScene) {
  const std::string readme = content(source / "README.md");
  for (const auto& scene : built_in_scenes())
    EXPECT_NE(readme.find("`" + scene.name + "`"), std::string::npos);
}

}  // namespace
}  // namespace jetlag::testing
