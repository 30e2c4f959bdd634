// SPDX-License-Identifier: MIT
#pragma once
// An output: what a run leaves behind in one format, in a folder.
//
// A new format is a file beside this one and a line in outputs.cpp. From then on runs write it, the program names its
// file, and what an earlier run has left of it goes.

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "jetlag/output/shape.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

/// A run that leaves files behind.
struct RecordedRun {
  const Scene& scene;
  std::filesystem::path folder;        // is there
  std::vector<std::string>& warnings;  // what could not be written although the run went well
};

class Output {
 public:
  virtual ~Output() = default;

  /// The name of its file in the folder of a run, or where it has several of the first to look at.
  virtual std::string file() const = 0;
  /// The others that are there, as names in that folder.
  virtual std::vector<std::filesystem::path> other_files(const std::filesystem::path& /*folder*/) const {
    return {};
  }
  /// Whether a scene that asks for these wants it.
  virtual bool is_wanted(const OutputOptions& /*asked*/) const { return true; }

  /// Called in this order: once, at time 0 and at each of the frames, once. What the updates and energies of a run amount
  /// to is in its result; at a frame it holds those so far.
  ///
  /// A run may be killed at any moment: what is under a name then is whole and of this run. So files are written by
  /// write_file, one that names others after them, and one that grows is written anew as it grows.
  virtual void begin(const RecordedRun& /*run*/) {}
  virtual void frame(const RecordedRun& /*run*/, const Frame& /*frame*/, const RunResult& /*so_far*/) {}
  virtual void end(const RecordedRun& /*run*/, const RunResult& /*result*/) {}

  /// When it ends: tables and lists of frames; then the summary, beside which these are complete; then pictures, which take
  /// seconds and may read the tables.
  enum class Turn { table, summary, picture };
  virtual Turn turn() const { return Turn::table; }
};

/// When a file that grows row by row is written anew: at each of its first rows, then when it has grown by a part of what
/// it was, so that all that is written is no more than a few times the last of it.
class ListGrowth {
 public:
  explicit ListGrowth(double part) : part_(part) {}

  bool is_due(std::size_t rows) {
    if (rows < due_) return false;
    due_ = rows + std::max<std::size_t>(
                      1, rows < first ? 1 : static_cast<std::size_t>(part_ * static_cast<double>(rows)));
    return true;
  }

 private:
  static constexpr std::size_t first = 256;
  double part_;
  std::size_t due_ = 0;
};

/// All of them, in the order in which they are named, and end within their turn.
std::vector<std::unique_ptr<Output>> all_outputs();

/// What a folder holds of an output, as names in the folder.
std::vector<std::filesystem::path> files_of(const Output& output, const std::filesystem::path& folder);

/// Removes what runs and ensembles have left in a folder under their names, so that nothing of them stands beside what
/// comes: a file that names others before them. But for scene.json: it may be the only copy of the scene that is run now,
/// which takes its place at once.
void remove_earlier_results(const std::filesystem::path& folder);

}  // namespace jetlag
