// SPDX-License-Identifier: MIT
#pragma once
// An output: what a run leaves behind in one format, in a folder.
//
// A new format is a file beside this one and a line in outputs.cpp. From then on runs write it, the program names its
// file, and what an earlier run has left of it goes.

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
  /// to is in its result.
  virtual void begin(const RecordedRun& /*run*/) {}
  virtual void frame(const RecordedRun& /*run*/, const Frame& /*frame*/) {}
  virtual void end(const RecordedRun& /*run*/, const RunResult& /*result*/) {}
};

/// All of them, in the order in which they end and are named.
std::vector<std::unique_ptr<Output>> all_outputs();

/// What a folder holds of an output, as names in the folder.
std::vector<std::filesystem::path> files_of(const Output& output, const std::filesystem::path& folder);

}  // namespace jetlag
