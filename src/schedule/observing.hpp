// SPDX-License-Identifier: MIT
#pragma once
// What all runs do alike: they refuse to go back, and hand out frames as the motion becomes known.

#include <algorithm>
#include <cstddef>
#include <stdexcept>

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

 private:
  const Observer& observer_;
  std::size_t next_;
};

}  // namespace jetlag
