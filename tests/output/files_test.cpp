// SPDX-License-Identifier: MIT
#include "jetlag/output/files.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// No file can grow beyond this size: the disk is full.
class FullDisk {
 public:
  explicit FullDisk(std::size_t size) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = size;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_;
  void (*signal_)(int);
};

std::string failure(const fs::path& path) {
  try {
    write_file(path, "new");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

using Files = Scratch;

TEST_F(Files, HoldWhatWasWritten) {
  const std::string text("line\n\0\xff", 7);
  write_file(folder / "a", "old");
  write_file(folder / "a", text);
  EXPECT_EQ(content(folder / "a"), text);
  EXPECT_EQ(read_file(folder / "a"), text);
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, KeepTheOldTextWhenTheDiskIsFull) {
  const std::string text(10000, 'x');
  for (const std::size_t size : {0, 1, 100, 4096, 9999}) {
    write_file(folder / "a", "old");
    {
      const FullDisk full(size);
      EXPECT_THROW(write_file(folder / "a", text), std::runtime_error) << size;
      EXPECT_THROW(write_file(folder / "b", text), std::runtime_error) << size;
    }
    EXPECT_EQ(content(folder / "a"), "old");
    EXPECT_EQ(count(), 1) << "no temporary file, no half-written one";
  }
  const FullDisk enough(text.size());
  write_file(folder / "a", text);
  EXPECT_EQ(content(folder / "a"), text);
}

TEST_F(Files, NameThePathAndTheReason) {
  const fs::path lost = folder / "lost" / "a", below_a_file = folder / "a" / "b";
  EXPECT_EQ(failure(lost), "cannot write " + lost.string() + ": No such file or directory");
  write_file(folder / "a", "old");
  EXPECT_EQ(failure(below_a_file), "cannot write " + below_a_file.string() + ": Not a directory");
  EXPECT_THROW(read_file(lost), std::runtime_error);
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, DoNotReplaceAFolderOrAPipe) {
  fs::create_directory(folder / "a");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(failure(folder / "a"), HasSubstr("Is a directory"));
  EXPECT_THAT(failure(folder / "pipe"), HasSubstr("pipe: Invalid argument"));
  EXPECT_TRUE(fs::is_directory(folder / "a"));
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_EQ(count(), 2);
}

TEST_F(Files, AreWrittenBesideTheDraftOfAnInterruptedRun) {
  std::ofstream(folder / (".jetlag-" + std::to_string(::getpid()) + "-0")) << "left over";
  write_file(folder / "a", "new");
  EXPECT_EQ(content(folder / "a"), "new");
  EXPECT_EQ(count(), 2);
}

}  // namespace
}  // namespace jetlag::testing
