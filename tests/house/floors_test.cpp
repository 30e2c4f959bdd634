// SPDX-License-Identifier: MIT
// A folder of the house includes its own and lower floors only.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> floor_of_folder = {
    {"series", 0},                       //
    {"tape", 1},        {"forces", 1},   //
    {"motion", 2},                       //
    {"truncation", 3},  {"control", 3},  //
    {"integrators", 4},                  //
    {"schedule", 5},                     //
    {"scenes", 6},      {"output", 6},   //
    {"studies", 7},
};
constexpr int roof = 7;     // the program
constexpr int outside = 8;  // the umbrella header: includes anything, is included by nobody in the house

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The files below `folder` that the compiler reads, in the order of their names.
std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// The floor of a file of the house at `root`; nothing when it stands in no known folder.
std::optional<int> floor_of(const fs::path& root, const fs::path& file) {
  const std::string path = fs::relative(file, root).generic_string();
  if (path == "src/main.cpp") return roof;
  if (path == "include/jetlag/jetlag.hpp") return outside;
  const auto below = [&](std::string_view prefix) { return path.starts_with(prefix) ? prefix.size() : 0; };
  const auto start = std::max(below("include/jetlag/"), below("src/"));
  const auto end = path.find('/', start);
  if (start == 0 || end == std::string::npos) return {};
  const auto found = floor_of_folder.find(path.substr(start, end - start));
  if (found == floor_of_folder.end()) return {};
  return found->second;
}

struct Include {
  std::string name;
  bool quoted;
};

/// What a line includes; nothing when it is not an #include line.
std::optional<Include> included_by(std::string_view line) {
  const auto skip = [&](std::string_view what) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const bool there = line.starts_with(what);
    if (there) line.remove_prefix(what.size());
    return there;
  };
  if (!skip("#") || !skip("include")) return {};
  const bool quoted = skip("\"");
  if (!quoted && !skip("<")) return {};
  return Include{std::string(line.substr(0, line.find(quoted ? '"' : '>'))), quoted};
}

/// What is wrong with one #include line of `file`; empty when nothing is.
std::string wrong_with_include(const fs::path& root, const fs::path& file, int floor,
                               const Include& include) {
  const auto& [name, quoted] = include;
  if (name == "jetlag/version.hpp") return {};  // generated, stands on the ground
  std::vector<fs::path> places = {root / "include" / name, root / "src" / name};
  if (quoted) places.insert(places.begin(), file.parent_path() / name);
  const auto target = std::ranges::find_if(places, [](const auto& p) { return fs::is_regular_file(p); });
  if (target == places.end()) return quoted || name.starts_with("jetlag/") ? "there is no such file" : "";
  const auto its_floor = floor_of(root, fs::weakly_canonical(*target));
  if (!its_floor) return "stands in no known folder";
  if (*its_floor > floor)
    return "points up, from floor " + std::to_string(floor) + " to " + std::to_string(*its_floor);
  return {};
}

/// Everything in the house at `root` that breaks a rule, one line each.
std::vector<std::string> offences(const fs::path& unresolved_root) {
  const fs::path root = fs::weakly_canonical(unresolved_root);
  std::vector<std::string> found;
  for (const char* part : {"include", "src"}) {
    for (const fs::path& file : sources_in(root / part)) {
      const auto report = [&](const std::string& what) {
        found.push_back(fs::relative(file, root).generic_string() + ": " + what);
      };
      const std::string extension = file.extension();
      if (extension != ".hpp" && extension != ".cpp") {
        report("is neither .hpp nor .cpp");
        continue;
      }
      const std::string text = contents(file);
      if (!text.starts_with("// SPDX-License-Identifier: MIT\n")) report("does not start with the SPDX line");
      if (extension == ".hpp" && text.find("\n#pragma once\n") == std::string::npos)
        report("has no #pragma once");
      const auto floor = floor_of(root, file);
      if (!floor) {
        report("stands in no known folder");
        continue;
      }
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) {
        const auto include = included_by(line);
        const std::string wrong = include ? wrong_with_include(root, file, *floor, *include) : "";
        if (!wrong.empty()) report("#include " + include->name + " " + wrong);
      }
    }
  }
  return found;
}

/// A house of a few files, for the time of a test.
class SmallHouse : public testing::Test {
 protected:
  SmallHouse() {
    fs::remove_all(root);
    fs::create_directories(root / "src");
    header("series/exp", "");
    header("motion/system", "#include \"jetlag/series/exp.hpp\"\n#include <vector>\n");
  }
  ~SmallHouse() override { fs::remove_all(root); }

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((root / path).parent_path());
    std::ofstream(root / path) << text;
  }
  void header(const std::string& name, const std::string& text) const {
    write("include/jetlag/" + name + ".hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n" + text);
  }
  void source(const std::string& name, const std::string& text) const {
    write("src/" + name + ".cpp", "// SPDX-License-Identifier: MIT\n" + text);
  }

  const fs::path root = fs::path(testing::TempDir()) / ("jetlag-house-" + std::to_string(getpid()));
};

using testing::ElementsAre;
using testing::IsEmpty;

TEST(House, KeepsItsRules) { EXPECT_THAT(offences(JETLAG_SOURCE_DIR), IsEmpty()); }

TEST_F(SmallHouse, MayIncludeItsOwnAndLowerFloors) {
  header("jetlag", "#include \"jetlag/motion/system.hpp\"\n");
  header("motion/piece", "#include <jetlag/motion/system.hpp>\n#include \"jetlag/version.hpp\"\n");
  source("main", "#include \"jetlag/motion/system.hpp\"\n#include \"studies/body.hpp\"\n");
  write("src/studies/body.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  EXPECT_THAT(offences(root), IsEmpty());
}

TEST_F(SmallHouse, MustNotIncludeAHigherFloor) {
  header("series/log", "#include \"jetlag/motion/system.hpp\"\n");
  source("series/sin", "  #  include <jetlag/motion/system.hpp>\n");
  EXPECT_THAT(
      offences(root),
      ElementsAre(
          "include/jetlag/series/log.hpp: #include jetlag/motion/system.hpp points up, from floor 0 to 2",
          "src/series/sin.cpp: #include jetlag/motion/system.hpp points up, from floor 0 to 2"));
}

TEST_F(SmallHouse, MustNotReachAHigherFloorBySideDoors) {
  source("series/log", "#include \"../../include/jetlag/motion/system.hpp\"\n");
  source("series/sin", "#include \"motion/inner.hpp\"\n");
  write("src/motion/inner.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  EXPECT_THAT(
      offences(root),
      ElementsAre(
          "src/series/log.cpp: #include ../../include/jetlag/motion/system.hpp points up, from floor 0 to 2",
          "src/series/sin.cpp: #include motion/inner.hpp points up, from floor 0 to 2"));
}

TEST_F(SmallHouse, MustNotIncludeTheUmbrella) {
  header("jetlag", "");
  source("main", "#include <jetlag/jetlag.hpp>\n");
  EXPECT_THAT(offences(root),
              ElementsAre("src/main.cpp: #include jetlag/jetlag.hpp points up, from floor 7 to 8"));
}

TEST_F(SmallHouse, HasNoUnknownRooms) {
  header("attic/box", "");
  header("loose", "");
  EXPECT_THAT(offences(root), ElementsAre("include/jetlag/attic/box.hpp: stands in no known folder",
                                          "include/jetlag/loose.hpp: stands in no known folder"));
}

TEST_F(SmallHouse, IncludesOnlyWhatExists) {
  source("series/log", "#include \"lost.hpp\"\n#include <jetlag/series/lost.hpp>\n");
  EXPECT_THAT(offences(root),
              ElementsAre("src/series/log.cpp: #include lost.hpp there is no such file",
                          "src/series/log.cpp: #include jetlag/series/lost.hpp there is no such file"));
}

TEST_F(SmallHouse, StartsEachFileWithItsLicence) {
  write("include/jetlag/series/log.hpp", "#pragma once\n");
  write("include/jetlag/series/sin.hpp", "// SPDX-License-Identifier: MIT\n");
  EXPECT_THAT(offences(root), ElementsAre("include/jetlag/series/log.hpp: does not start with the SPDX line",
                                          "include/jetlag/series/log.hpp: has no #pragma once",
                                          "include/jetlag/series/sin.hpp: has no #pragma once"));
}

}  // namespace
