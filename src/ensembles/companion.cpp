// SPDX-License-Identifier: MIT
#include "ensembles/companion.hpp"

namespace jetlag {

bool Companion::advance_to(double time, const std::function<bool()>& go_on) {
  while (report_.outcome == Outcome::success && state_.time < time) {
    if (go_on && !go_on()) {
      report_ = interrupted(state_.time);
    } else if (taylor_.work().steps >= max_steps_) {
      report_ = step_limit(max_steps_, state_.time);
    } else {
      const double limit = end_ - state_.time, h = taylor_.step(state_, limit, report_);
      if (report_.outcome == Outcome::success) state_.time = h == limit ? end_ : state_.time + h;
    }
  }
  if (report_.outcome != Outcome::success) return false;
  seen_ = state_.time == time ? state_ : taylor_.motion().at(time);
  return true;
}

}  // namespace jetlag
