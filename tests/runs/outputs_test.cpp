// SPDX-License-Identifier: MIT
// What holds for every output: it is written where it is asked for, and removed where an earlier run has left it.
#include <gmock/gmock.h>

#include <set>

#include "jetlag/pictures/pictures.hpp"
#include "runs/outputs/output.hpp"
#include "support/program.hpp"

namespace jetlag::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::Not;

namespace fs = std::filesystem;

Scene scene(const std::vector<std::string>& more) {
  std::vector<std::string> settings = {"until=0.2", "output.frames=5"};
  settings.insert(settings.end(), more.begin(), more.end());
  return load_scene("chain", settings);
}

/// The settings that ask for all that can be asked for, or for none of it.
std::vector<std::string> all(bool asked) {
  std::vector<std::string> settings;
  for (const OutputKey& key : output_keys)
    settings.push_back("output." + std::string(key.name) + (asked ? "=true" : "=false"));
  return settings;
}

/// All files below a folder, as names in it.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

/// Runs it into the folder; the files of the outputs that it asks for.
std::set<std::string> run_into(const Scene& scene, const fs::path& folder) {
  std::vector<std::string> warnings;
  EXPECT_EQ(run_scene_into(scene, folder, {}, warnings).summary.outcome, Outcome::success);
  if (can_draw()) {
    EXPECT_THAT(warnings, IsEmpty());
  }
  std::set<std::string> files;
  for (const auto& output : all_outputs())
    if (output->is_wanted(scene.output))
      for (const auto& file : files_of(*output, folder)) files.insert(file.string());
  return files;
}

TEST(Outputs, HaveNamesOfTheirOwnWithinTheFolder) {
  std::set<std::string> names;
  for (const auto& output : all_outputs()) {
    EXPECT_TRUE(names.insert(output->file()).second) << output->file();
    const fs::path path = output->file();
    EXPECT_TRUE(path.is_relative() && path == path.lexically_normal() && *path.begin() != "..") << path;
  }
}

TEST(Outputs, AreAllThatARunLeaves) {
  const TemporaryFolder folder;
  const auto wanted = run_into(scene(all(true)), folder.path());
  EXPECT_EQ(files_in(folder.path()), wanted);
}

TEST(Outputs, AreThereWhereTheyAreWanted) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  const Scene asking = scene(all(true));
  run_into(asking, folder.path());
  for (const auto& output : all_outputs()) {
    EXPECT_TRUE(output->is_wanted(asking.output)) << output->file();
    EXPECT_TRUE(fs::exists(folder / output->file())) << output->file();
  }
}

TEST(Outputs, OfAnEarlierRunGo) {
  const TemporaryFolder folder;
  run_into(scene(all(true)), folder.path());
  const auto before = files_in(folder.path());
  auto settings = all(false);
  settings.push_back("output.frames=3");
  const auto wanted = run_into(scene(settings), folder.path());
  EXPECT_EQ(files_in(folder.path()), wanted);
  EXPECT_LT(wanted.size(), before.size());
  EXPECT_THAT(wanted, IsSubsetOf(before));
}

/// It may be the one that is run now, and the only copy: it is replaced, never gone.
TEST(Outputs, OfAnEarlierRunGoButForTheScene) {
  const TemporaryFolder folder;
  run_into(scene(all(true)), folder.path());
  write(folder / "ensemble.csv", "of an ensemble");
  remove_earlier_results(folder.path());
  EXPECT_EQ(files_in(folder.path()), std::set<std::string>{"scene.json"});
  EXPECT_FALSE(fs::exists(folder / "frames"));
}

/// Each row of a few, and of many so seldom that all that is written is a few times the last of it.
TEST(Growth, IsDueAtEachOfTheFirstRowsAndThenInProportion) {
  ListGrowth growth(1. / 32);
  std::size_t written = 0;
  for (std::size_t rows = 1; rows <= 100000; ++rows) {
    const bool due = growth.is_due(rows);
    EXPECT_TRUE(due || rows >= 256) << rows;
    if (due) written += rows;
  }
  EXPECT_LE(written, 256u * 256 / 2 + 33u * 100000);  // the sum of a geometric series of ratio 1 + 1/32
  EXPECT_GE(written, 31u * 100000);
}

TEST(Outputs, WithoutFramesAreOfTheBeginningAndTheEnd) {
  const Scene none = scene({"output.frames=0"});
  std::vector<double> times;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { times.push_back(frame.time); };
  const RunResult result = run_scene(none, hooks);
  EXPECT_EQ(times, (std::vector<double>{0, 0.2}));
  EXPECT_EQ(result.energies.size(), 2u);
  EXPECT_EQ(result.summary.position, run_scene(scene({})).summary.position);
}

TEST(Outputs, LeaveOtherFilesAlone) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "frames");
  const std::set<std::string> mine = {"notes.txt", "energy.csv.txt", "frames/frame_7.vtu", "frames/run.txt"};
  for (const std::string& name : mine) write(folder / name, "mine");
  run_into(scene({}), folder.path());
  for (const std::string& name : mine) EXPECT_EQ(content(folder / name), "mine") << name;
}

/// Each for itself.
TEST(Outputs, KnowAllTheirFiles) {
  const TemporaryFolder folder;
  const Scene asking = scene(all(true));
  std::vector<std::string> warnings;
  const RunResult result = run_scene(asking);
  for (const auto& output : all_outputs()) {
    if (output->file().ends_with(".svg") || output->file().ends_with(".png")) continue;  // pictures
    const fs::path own = folder / ("of_" + fs::path(output->file()).stem().string());
    fs::create_directories(own);
    const RecordedRun run{asking, own, warnings};
    output->begin(run);
    output->frame(run, {0.0, asking.initial.position, asking.initial.velocity}, result);
    output->end(run, result);
    std::set<std::string> known;
    for (const auto& file : files_of(*output, own)) known.insert(file.string());
    EXPECT_EQ(known, files_in(own)) << output->file();
  }
}

TEST(Outputs, AreNamedByTheProgram) {
  const TemporaryFolder folder;
  const Ended run =
      program("run chain --set until=0.2 --set output.pictures=false --set output.clocks=true --out out",
              folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const auto files = first_files_of_run(folder / "out");
  ASSERT_THAT(files, Not(IsEmpty()));
  EXPECT_EQ(files.front(), folder / "out/summary.json");
  EXPECT_THAT(files, Contains(folder / "out/clocks.csv"));
  for (const auto& file : files)
    EXPECT_THAT(run.output, HasSubstr(fs::relative(file, folder.path()).string())) << file;
}

}  // namespace
}  // namespace jetlag::testing
