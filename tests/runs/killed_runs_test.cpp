// SPDX-License-Identifier: MIT
// Whatever happens to a process: what is under a name is whole and of one run, and two do not write into one folder.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "jetlag/output/result_folder.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

struct Listed {
  std::vector<double> times;
  std::vector<std::string> files;
};

Listed listed(const fs::path& pvd) {
  const std::string text = content(pvd);
  EXPECT_TRUE(text.ends_with("</VTKFile>\n")) << "it is whole";
  Listed list;
  const std::regex entry("timestep=\"([^\"]*)\".*file=\"([^\"]*)\"");
  for (std::sregex_iterator match(text.begin(), text.end(), entry), none; match != none; ++match) {
    list.times.push_back(std::stod((*match)[1]));
    list.files.push_back((*match)[2]);
  }
  return list;
}

/// The first column of a table, without its head.
std::vector<double> times_of(const fs::path& table) {
  std::istringstream text(content(table));
  std::vector<double> times;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), 4) << line;
    times.push_back(std::stod(line));
  }
  return times;
}

/// Kills a run into `out` when it has written its frame 150: a frame every 100 s, far from its end.
void kill_a_run(const TemporaryFolder& folder) {
  const Ended killed =
      program("--version && { '" JETLAG_PROGRAM
              "' run two_body --out out --quiet --set until=1e8 --set output.frames=1000000 & p=$!; "
              "for i in {1..2000}; do [ -e out/frames/frame_000150.vtu ] && break; sleep 0.01; done; "
              "kill -KILL $p; wait $p; }",
              folder.path());
  ASSERT_EQ(killed.exit_code, 128 + 9) << killed.output;
}

TEST(KilledRun, LeavesListsAndTablesOfItsOwn) {
  const TemporaryFolder folder;
  // An earlier run, with all that there is, and an ensemble before it.
  for (const char* earlier : {"ensemble ellipse --members 2 --set until=0.1", "run chain --set until=0.5"})
    ASSERT_EQ(program(earlier + std::string(" --quiet --out out"), folder.path()).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/ensemble.json")) << "beside the scene of another run";
  kill_a_run(folder);

  auto names = names_in(folder / "out");
  std::erase_if(names, [](const std::string& name) { return name.starts_with(".jetlag-"); });
  EXPECT_EQ(names, (std::set<std::string>{"scene.json", "energy.csv", "frames"}));
  EXPECT_THAT(content(folder / "out/scene.json"), HasSubstr("100000000.0"));
  const Listed list = listed(folder / "out/frames/run.pvd");
  const auto energies = times_of(folder / "out/energy.csv");
  EXPECT_GE(list.files.size(), 150u);
  for (std::size_t i = 0; i < list.files.size(); ++i) {
    const std::string frame = content(folder / "out/frames" / list.files[i]);
    EXPECT_TRUE(frame.ends_with("</VTKFile>\n")) << list.files[i];
    EXPECT_EQ(list.times[i], 100.0 * static_cast<double>(i));
  }
  for (std::size_t i = 0; i < energies.size(); ++i) EXPECT_EQ(energies[i], 100.0 * static_cast<double>(i));
  // A file is behind another by the frame that was being written, and of more than 256 rows by 1/32 of them.
  const auto frames = static_cast<double>(std::ranges::count_if(
      names_in(folder / "out/frames"), [](const auto& name) { return name.starts_with("frame_"); }));
  EXPECT_NEAR(static_cast<double>(list.files.size()), frames, 1 + frames / 32);
  EXPECT_NEAR(static_cast<double>(energies.size()), frames, 1 + frames / 32);
}

TEST(KilledRun, IsSweptByTheNext) {
  const TemporaryFolder folder;
  kill_a_run(folder);
  for (const char* draft : {"out/.jetlag-1-0", "out/frames/.jetlag-1-0"}) write(folder / draft, "half");
  const Ended next =
      program("run chain --set until=0.5 --set output.pictures=false --quiet --out out", folder.path());
  ASSERT_EQ(next.exit_code, 0) << next.output;
  EXPECT_EQ(names_in(folder / "out"),
            (std::set<std::string>{"scene.json", "summary.json", "energy.csv", "frames"}));
  EXPECT_EQ(listed(folder / "out/frames/run.pvd").files.size() + 1, names_in(folder / "out/frames").size());
}

TEST(Run, WithoutFramesLeavesNone) {
  const TemporaryFolder folder;
  for (const char* frames : {"3", "0"})
    ASSERT_EQ(program(std::string("run chain --set until=0.5 --set output.pictures=false --quiet --out out "
                                  "--set output.frames=") +
                          frames,
                      folder.path())
                  .exit_code,
              0);
  EXPECT_EQ(names_in(folder / "out"), (std::set<std::string>{"scene.json", "summary.json", "energy.csv"}));
  EXPECT_EQ(times_of(folder / "out/energy.csv"), (std::vector<double>{0, 0.5}));
}

TEST(Run, IsRefusedWhereAnotherOneWrites) {
  const TemporaryFolder folder;
  ASSERT_EQ(program("run chain --set until=0.5 --quiet --out out", folder.path()).exit_code, 0);
  const std::string before = content(folder / "out/summary.json");
  {
    const ResultFolder held(folder / "out");
    for (const char* second :
         {"run two_body --set until=1 --out out", "ensemble ellipse --members 2 --out out",
          "stability --out out", "methods --out out"}) {
      const Ended refused = program(second, folder.path());
      EXPECT_EQ(refused.exit_code, 1) << second << refused.output;
      EXPECT_THAT(refused.output,
                  AllOf(HasSubstr("cannot write out: another run"), HasSubstr("another folder")));
    }
    EXPECT_EQ(content(folder / "out/summary.json"), before);
  }
  EXPECT_EQ(program("run chain --set until=0.5 --quiet --out out", folder.path()).exit_code, 0);
}

}  // namespace
}  // namespace jetlag::testing
