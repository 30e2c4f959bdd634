// SPDX-License-Identifier: MIT
#pragma once
// The frames of a run, handed out as the motion becomes known.

#include <algorithm>
#include <cstddef>

#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

class Frames {
 public:
  /// Frames up to `begin` are left out: the caller has that state.
  Frames(const RunOptions& options, double begin)
      : options_(options),
        next_(std::ranges::upper_bound(options.frame_times, begin) - options.frame_times.begin()) {}

  /// Whether there is one up to a time.
  bool wants(double time) const {
    return options_.at_frame && next_ < options_.frame_times.size() && options_.frame_times[next_] <= time;
  }

  /// All of them up to a time; at(t): the state at t.
  template <class At>
  void up_to(double time, const At& at) {
    while (wants(time)) options_.at_frame(at(options_.frame_times[next_++]));
  }

 private:
  const RunOptions& options_;
  std::size_t next_;
};

}  // namespace jetlag
