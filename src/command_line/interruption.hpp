// SPDX-License-Identifier: MIT
#pragma once
// What long commands have in common: they can be stopped in good order, and say how far they are.

#include <cstdint>

#include "jetlag/base/stopwatch.hpp"

namespace jetlag {

/// The first Ctrl-C (or SIGTERM, or SIGHUP: the terminal is closed) lets a run end in good order, the second ends the
/// program.
void stop_in_good_order();
bool stop_requested();

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
