// SPDX-License-Identifier: MIT
#pragma once
// Steps that end where a choice in a force changes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace jetlag {

/// Ends a step just beyond the change, far enough that the next one sees it: that may take some places of the time and of the
/// state, more where that was not enough before. A step of next to no length is one that is no longer than 2^12 times that.
template <class T>
class StepsToChanges {
 public:
  /// The step: `length` > 0, as far as choices are known, or to a change of which its series says that it comes after that time.
  /// asked: the step that is to be, >= length.
  T step(const T& asked, const T& length, const T& time, const std::optional<T>& change) {
    using std::abs;
    is_to_change_ = change.has_value();
    if (!change) {
      short_ = length < asked * T(0x1p-40) ? short_ + 1 : 0;
      instants_ = length < asked * T(0x1p-200) ? instants_ + 1 : 0;
      return length;
    }
    const T place = std::numeric_limits<T>::epsilon() * abs(time);
    // Where the time is 0, or next to it, its places say nothing of the state's: the least step grows until it is seen.
    T least = place * T(std::ldexp(1.0, std::min(instants_, 20)));
    const T part = length * T(std::ldexp(1.0, -200 + 4 * std::min(instants_, 37)));
    if (least < part) least = part;
    T step = *change < length ? *change : length;
    const bool is_instant = !(least * T(0x1p12) < step);  // the way back may be slower
    if (step < least) step = least;
    if (length < step) step = length;
    instants_ = is_instant ? instants_ + 1 : 0;
    if (!(step < asked * T(0x1p-40)))
      short_ = 0;  // a change that is reached is as it should be, however soon
    return step;
  }
  /// The step becomes shorter: it leads to no change, and counts as it does.
  void shorten() { is_to_change_ = false; }
  /// One that leads to no change.
  void take_none() { *this = {}; }

  /// Whether the step leads to a change.
  bool is_to_change() const { return is_to_change_; }
  /// Whether its length is next to none.
  bool is_instant() const { return instants_ > 0; }
  /// Whether 100 of them have come in a row: the motion slides along a jump of the force or chatters about it. Or, with no
  /// longer step in between, 10000 that end without a change before 2^-40 of what is asked for: it would take years.
  bool is_stuck() const { return instants_ >= 100 || short_ >= 10000; }
  /// Why; `what` makes the choices: "a force".
  std::string cause(const std::string& what, const std::string& time) const {
    if (instants_ < 100)
      return "what choices in " + what +
             " depend on is not known for even 2^-40 of the step at a time, at t = " + time +
             ": its numbers are too large, or change too fast, for steps of this length";
    return "choices in " + what + " change again and again with next to no time in between, at t = " + time +
           ": the motion slides along a jump of " + (what == "f" ? "f" : "the force") +
           " or chatters about it; end the run before";
  }

 private:
  bool is_to_change_ = false;
  int instants_ = 0, short_ = 0;
};

}  // namespace jetlag
