// SPDX-License-Identifier: MIT
// A file is read in one sitting and a folder at one glance.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int most_lines = 400, most_files = 20;
constexpr int lines_for_a_reason = 6;  // a longer file says there:  // Long because ...

/// What is too large in a folder and below it, one line each.
std::vector<std::string> too_large(const fs::path& root) {
  std::vector<std::string> found;
  std::map<std::string, int> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || (path.extension() != ".hpp" && path.extension() != ".cpp")) continue;
    ++files[fs::relative(path.parent_path(), root.parent_path()).generic_string()];
    std::ifstream text(path);
    int lines = 0;
    bool has_reason = false;
    for (std::string line; std::getline(text, line); ++lines)
      has_reason = has_reason || (lines < lines_for_a_reason && line.starts_with("// Long because "));
    if (lines > most_lines && !has_reason)
      found.push_back(fs::relative(path, root.parent_path()).generic_string() + ": " + std::to_string(lines) +
                      " lines");
  }
  for (const auto& [folder, count] : files)
    if (count > most_files) found.push_back(folder + ": " + std::to_string(count) + " files");
  std::ranges::sort(found);
  return found;
}

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Sizes, AreWithinTheirLimits) {
  for (const char* part : {"src", "include", "tests", "bench"})
    EXPECT_THAT(too_large(fs::path(JETLAG_SOURCE_DIR) / part), IsEmpty()) << part;
}

TEST(Sizes, AreCountedInLinesAndFiles) {
  const fs::path root = fs::path(testing::TempDir()) / ("jetlag-sizes-" + std::to_string(getpid())) / "src";
  fs::remove_all(root);
  const auto write = [&](const std::string& name, int lines, const std::string& first) {
    fs::create_directories((root / name).parent_path());
    std::ofstream text(root / name);
    text << first << '\n';
    for (int i = 1; i < lines; ++i) text << '\n';
  };
  for (int i = 0; i < 20; ++i) write("full/" + std::to_string(i) + ".hpp", 1, "");
  for (int i = 0; i < 21; ++i) write("crowded/" + std::to_string(i) + ".cpp", 1, "");
  write("full/notes.md", 500, "");
  write("room/just.cpp", 400, "");
  write("room/long.cpp", 401, "// Long for no reason.");
  write("room/table.cpp", 401, "// Long because it is one table.");
  EXPECT_THAT(too_large(root), ElementsAre("src/crowded: 21 files", "src/room/long.cpp: 401 lines"));
  fs::remove_all(root.parent_path());
}

}  // namespace
