// SPDX-License-Identifier: MIT
#pragma once
// A folder for the results of one run at a time.

#include <filesystem>

namespace jetlag {

/// Holds a folder as long as it lives: who comes second is refused. The hold dies with the process, however that ends, and
/// leaves no file; it is of the system that runs the process (flock), and on file systems that know none there is none.
class ResultFolder {
 public:
  /// Makes the folder where it is not there, takes hold of it, and sweeps the drafts of processes that were killed.
  /// Throws std::runtime_error with its name and the reason, one of them that another run holds it.
  explicit ResultFolder(const std::filesystem::path& folder);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

 private:
  int folder_;
};

}  // namespace jetlag
