// SPDX-License-Identifier: MIT
// A room of the house includes what the list of rooms allows, and nothing else.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Which rooms the headers and sources of a room may include: public headers (include/jetlag/ROOM), and the private ones
/// (src/ROOM) of those in `inner`. A room may only name rooms above it in this list, so that no arrow runs in a circle.
struct Room {
  std::string name;
  std::set<std::string> may_include, inner = {};
};

const std::vector<Room> house = {
    {"base", {}},
    {"series", {"base"}},
    {"tape", {"base", "series"}},
    {"forces", {"base", "series", "tape"}},
    {"model", {"base", "series", "tape", "forces"}},
    {"motion", {"base", "series", "tape", "model"}},
    {"contact", {"base", "series", "forces", "model"}},
    {"truncation", {"base"}},
    {"problems", {"forces", "model", "truncation"}},
    {"control", {"base", "model", "motion", "truncation"}, {"model"}},
    {"integrators",
     {"base", "series", "model", "motion", "truncation", "control"},
     {"base", "model", "truncation"}},
    {"ensembles",
     {"base", "series", "tape", "model", "motion", "truncation", "control", "integrators"},
     {"base", "truncation"}},
    {"schedule", {"base", "series", "tape", "model", "motion", "truncation", "control", "integrators"}},
    {"output", {"base", "model", "motion", "contact", "schedule"}},
    {"pictures", {"base", "model", "output"}},
    {"scenes",
     {"base", "forces", "model", "motion", "contact", "truncation", "control", "integrators", "ensembles",
      "schedule", "output"}},
    {"runs",
     {"base", "tape", "model", "contact", "truncation", "control", "ensembles", "schedule", "output",
      "pictures", "scenes"},
     {"base", "ensembles"}},
    {"command_line", {"base", "scenes"}},
    {"studies",
     {"base", "tape", "forces", "model", "motion", "truncation", "control", "integrators", "ensembles",
      "schedule", "output", "pictures", "scenes", "runs"},
     {"pictures", "problems", "scenes", "command_line"}},
    {"program",
     {"base", "tape", "model", "motion", "truncation", "control", "output", "scenes", "runs"},
     {"pictures", "scenes", "command_line"}},
    // The two programs, and the umbrella header, which nobody in the house includes.
    {"src/main.cpp", {"model"}, {"program"}},
    {"src/study.cpp", {}, {"studies"}},
    {"include/jetlag/jetlag.hpp",
     {"base", "series", "tape", "forces", "model", "motion", "contact", "truncation", "control",
      "integrators", "ensembles", "schedule"}},
};

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

const Room* room_called(const std::string& name) {
  const auto found = std::ranges::find(house, name, &Room::name);
  return found == house.end() ? nullptr : &*found;
}

struct Place {
  const Room* room;
  bool is_public;
};

/// Where a file of the house at `root` stands; no room when it is in no known folder.
Place place_of(const fs::path& root, const fs::path& file) {
  const std::string path = fs::relative(file, root).generic_string();
  if (const Room* itself = room_called(path)) return {itself, false};
  for (const std::string part : {"include/jetlag/", "src/"}) {
    if (!path.starts_with(part)) continue;
    const auto end = path.find('/', part.size());
    if (end == std::string::npos) return {nullptr, false};
    return {room_called(path.substr(part.size(), end - part.size())), part != "src/"};
  }
  return {nullptr, false};
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

/// What is wrong with one #include line of `file`, which stands in `room`; empty when nothing is.
std::string wrong_with_include(const fs::path& root, const fs::path& file, const Room& room,
                               const Include& include) {
  const auto& [name, quoted] = include;
  if (name == "jetlag/version.hpp") return {};  // generated, stands on the ground
  std::vector<fs::path> places = {root / "include" / name, root / "src" / name};
  if (quoted) places.insert(places.begin(), file.parent_path() / name);
  const auto target = std::ranges::find_if(places, [](const auto& p) { return fs::is_regular_file(p); });
  if (target == places.end()) return quoted || name.starts_with("jetlag/") ? "there is no such file" : "";
  const Place place = place_of(root, fs::weakly_canonical(*target));
  if (place.room == nullptr) return "stands in no known folder";
  const std::string& there = place.room->name;
  if (there == room.name) return {};
  if (!(place.is_public ? room.may_include : room.inner).contains(there))
    return room.name + " may not include " + (place.is_public ? "" : "private headers of ") + there;
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
      if (extension == ".md") continue;  // for people
      if (extension != ".hpp" && extension != ".cpp") {
        report("is neither .hpp nor .cpp");
        continue;
      }
      const std::string text = contents(file);
      if (!text.starts_with("// SPDX-License-Identifier: MIT\n")) report("does not start with the SPDX line");
      if (extension == ".hpp" && text.find("\n#pragma once\n") == std::string::npos)
        report("has no #pragma once");
      const Room* room = place_of(root, file).room;
      if (room == nullptr) {
        report("stands in no known folder");
        continue;
      }
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) {
        const auto include = included_by(line);
        const std::string wrong = include ? wrong_with_include(root, file, *room, *include) : "";
        if (!wrong.empty()) report("#include " + include->name + ": " + wrong);
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
    header("series/functions/exp", "");
    header("model/system", "#include \"jetlag/series/functions/exp.hpp\"\n#include <vector>\n");
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

TEST(House, HasNoArrowsInACircle) {
  std::set<std::string> above;
  for (const Room& room : house) {
    for (const auto* names : {&room.may_include, &room.inner})
      for (const std::string& name : *names)
        EXPECT_TRUE(above.contains(name)) << room.name << " is named before " << name;
    above.insert(room.name);
  }
}

TEST_F(SmallHouse, MayIncludeItsOwnRoomAndThoseAllowed) {
  header("jetlag", "#include \"jetlag/model/system.hpp\"\n");
  header("model/kinks", "#include <jetlag/model/system.hpp>\n#include \"jetlag/version.hpp\"\n");
  source("main", "#include \"jetlag/model/system.hpp\"\n#include \"program/body.hpp\"\n");
  source("model/inner", "#include \"model/lists.hpp\"\n");
  write("src/program/body.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  write("src/model/lists.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  EXPECT_THAT(offences(root), IsEmpty());
}

TEST_F(SmallHouse, MustNotIncludeOtherRooms) {
  header("series/log", "#include \"jetlag/model/system.hpp\"\n");
  source("series/sin", "  #  include <jetlag/model/system.hpp>\n");
  header("truncation/law",
         "#include \"jetlag/series/functions/exp.hpp\"\n");  // a lower room, but no business of this one
  EXPECT_THAT(
      offences(root),
      ElementsAre(
          "include/jetlag/series/log.hpp: #include jetlag/model/system.hpp: series may not include model",
          "include/jetlag/truncation/law.hpp: #include jetlag/series/functions/exp.hpp: truncation may not "
          "include "
          "series",
          "src/series/sin.cpp: #include jetlag/model/system.hpp: series may not include model"));
}

TEST_F(SmallHouse, MustNotReachOtherRoomsBySideDoors) {
  source("series/log", "#include \"../../include/jetlag/model/system.hpp\"\n");
  source("series/sin", "#include \"model/inner.hpp\"\n");
  write("src/model/inner.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  EXPECT_THAT(
      offences(root),
      ElementsAre(
          "src/series/log.cpp: #include ../../include/jetlag/model/system.hpp: series may not include model",
          "src/series/sin.cpp: #include model/inner.hpp: series may not include private headers of model"));
}

TEST_F(SmallHouse, KeepsPrivateHeadersPrivate) {
  source("control/step", "#include \"motion/inner.hpp\"\n");
  write("src/motion/inner.hpp", "// SPDX-License-Identifier: MIT\n#pragma once\n");
  EXPECT_THAT(offences(root),
              ElementsAre("src/control/step.cpp: #include motion/inner.hpp: control may not include "
                          "private headers of motion"));
}

TEST_F(SmallHouse, MustNotIncludeTheUmbrella) {
  header("jetlag", "");
  source("main", "#include <jetlag/jetlag.hpp>\n");
  EXPECT_THAT(offences(root),
              ElementsAre("src/main.cpp: #include jetlag/jetlag.hpp: src/main.cpp may not include "
                          "private headers of include/jetlag/jetlag.hpp"));
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
              ElementsAre("src/series/log.cpp: #include lost.hpp: there is no such file",
                          "src/series/log.cpp: #include jetlag/series/lost.hpp: there is no such file"));
}

TEST_F(SmallHouse, StartsEachFileWithItsLicence) {
  write("include/jetlag/series/log.hpp", "#pragma once\n");
  write("include/jetlag/series/sin.hpp", "// SPDX-License-Identifier: MIT\n");
  EXPECT_THAT(offences(root), ElementsAre("include/jetlag/series/log.hpp: does not start with the SPDX line",
                                          "include/jetlag/series/log.hpp: has no #pragma once",
                                          "include/jetlag/series/sin.hpp: has no #pragma once"));
}

}  // namespace
