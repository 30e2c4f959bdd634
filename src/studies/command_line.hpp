// SPDX-License-Identifier: MIT
#pragma once
// What the commands of the program have in common.

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

constexpr int bad_input = 2, not_finished = 3;  // exit codes

/// The first Ctrl-C (or SIGTERM, or SIGHUP: the terminal is closed) lets a run end in good order, the second ends the
/// program.
void stop_in_good_order();
bool stop_requested();

/// "--out FOLDER", which must not be empty when it is given.
void add_out(CLI::App& command, std::filesystem::path& folder, const std::string& description);

struct SceneArguments {
  std::string scene;
  std::vector<std::string> settings;
  std::string seed;

  void add_to(CLI::App& command);
  /// Throws SceneError.
  Scene load() const;
};

/// A line that says how far a run is and how long it will still take: renewed in place on a terminal, now and then a
/// new one in a log.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  /// count of what: steps, members.
  void show(double time, double until, std::uint64_t count, const char* what);

 private:
  bool quiet_, terminal_, shown_ = false;
  Stopwatch since_begin_, since_shown_;
};

}  // namespace jetlag
