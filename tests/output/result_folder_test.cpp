// SPDX-License-Identifier: MIT
#include "jetlag/output/result_folder.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "jetlag/output/files.hpp"
#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using ResultFolders = Scratch;

TEST_F(ResultFolders, AreHeldByOneAtATime) {
  const fs::path out = folder / "a/b";
  std::optional<ResultFolder> first(out);
  fs::create_directory_symlink(out, folder / "link");
  for (const fs::path& same : {out, folder / "a/../a/b/", folder / "link"})
    EXPECT_THAT([&] { ResultFolder second(same); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(same.string()), HasSubstr("another run"))));
  EXPECT_NO_THROW(ResultFolder(folder / "a"));
  first.reset();
  EXPECT_NO_THROW(ResultFolder{out});
  EXPECT_TRUE(fs::is_empty(out)) << "a hold is no file";
}

TEST_F(ResultFolders, LoseTheDraftsOfWhoWasKilled) {
  for (const char* name :
       {".jetlag-1-0", ".jetlag-4194304-12", "notes", ".jetlag-1", ".jetlag-1-x", ".jetlag-1-0.txt"})
    write_file(folder / name, "text");
  fs::create_directory(folder / ".jetlag-7-1");
  write_file(folder / ".jetlag-7-1/script", "plot");
  const ResultFolder held(folder);
  EXPECT_EQ(count(), 4u);
  for (const char* name : {"notes", ".jetlag-1", ".jetlag-1-x", ".jetlag-1-0.txt"})
    EXPECT_TRUE(fs::exists(folder / name));
}

TEST_F(ResultFolders, SweepWhatDraftsAreCalled) {
  for (const int n : {0, 1, 10}) write_file(draft_beside(folder / "a", n), "half");
  sweep_drafts(folder);
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_NO_THROW(sweep_drafts(folder / "lost"));
}

}  // namespace
}  // namespace jetlag::testing
