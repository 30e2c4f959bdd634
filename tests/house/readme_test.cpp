// SPDX-License-Identifier: MIT
// What the README shows is what is compiled and what the program says.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

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
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  for (const std::filesystem::path page : {"README.md", "bench/README.md", "bench/methods.md"}) {
    const std::string text = content(source / page);
    int links = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), link), none; match != none; ++match, ++links)
      EXPECT_TRUE(std::filesystem::exists(source / page.parent_path() / (*match)[1].str()))
          << page << ": " << (*match)[1];
    EXPECT_GT(links, 0) << page;
  }
}

TEST(Readme, NamesOnlyFilesToWriteOrToAddToThatAreThere) {
  // The files that a new member is added to; those that it writes are not there yet.
  const std::string readme = content(source / "README.md");
  const std::string table = between(readme, "## Where to add", "A room includes");
  std::istringstream rows(table);
  for (std::string row; std::getline(rows, row);) {
    std::vector<std::string> cells;
    std::istringstream parts(row);
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
    if (cells.size() < 4) continue;
    const std::regex quoted(R"(`([a-z0-9_/]+/[a-z0-9_]+\.[ch]pp)`)");
    for (std::sregex_iterator match(cells[3].begin(), cells[3].end(), quoted), none; match != none; ++match) {
      const std::string name = (*match)[1];
      EXPECT_TRUE(std::filesystem::exists(source / name) ||
                  std::filesystem::exists(source / "include/jetlag" / name))
          << name;
    }
  }
}

TEST(Readme, NamesEveryBuiltInScene) {
  const std::string readme = content(source / "README.md");
  for (const auto& scene : built_in_scenes())
    EXPECT_NE(readme.find("`" + scene.name + "`"), std::string::npos);
}

}  // namespace
}  // namespace jetlag::testing
