// SPDX-License-Identifier: MIT
#pragma once
// What all runs do alike: they refuse to go back, and hand out frames as the motion becomes known.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

inline void require_not_before(const State<double>& state, double until) {
  if (!(until >= state.time))
    throw std::invalid_argument("run: until must not lie before the time of the state");
}

class Frames {
 public:
  /// Keeps a reference to the observer. Frames up to `begin` are left out: the caller has that state.
  Frames(const Observer& observer, double begin)
      : observer_(observer),
        next_(std::ranges::upper_bound(observer.frame_times, begin) - observer.frame_times.begin()) {}

  /// Whether there is one up to a time.
  bool wants(double time) const {
    return observer_.at_frame && next_ < observer_.frame_times.size() && observer_.frame_times[next_] <= time;
  }

  /// All of them up to a time; at(t): the state at t.
  template <class At>
  void up_to(double time, const At& at) {
    while (wants(time)) observer_.at_frame(at(observer_.frame_times[next_++]));
  }

  /// All of them in a step to `end`, of which this is the motion.
  void up_to(const State<double>& end, const PieceView& motion) {
    const std::vector<double>& times = observer_.frame_times;
    while (wants(end.time)) {
      std::size_t count = 1;
      while (count < room_.size() && next_ + count < times.size() && times[next_ + count] <= end.time)
        ++count;
      motion.at(std::span(times).subspan(next_, count), room_);
      for (std::size_t i = 0; i < count; ++i) observer_.at_frame(times[next_++] == end.time ? end : room_[i]);
    }
  }

 private:
  const Observer& observer_;
  std::size_t next_;
  std::array<State<double>, 4> room_;  // for frames
};

}  // namespace jetlag
