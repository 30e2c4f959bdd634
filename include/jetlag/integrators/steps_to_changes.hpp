// SPDX-License-Identifier: MIT
#pragma once
// Steps that end where a choice in a force changes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace jetlag {

/// Ends a step just beyond the change, far enough that the next one sees it: that may take some places of the time and of the
/// state, more where that was not enough before.
template <class T>
class StepsToChanges {
 public:
  /// The step: `length` > 0, or to a change of which its series says that it comes after that time.
  T step(const T& length, const T& time, const std::optional<T>& change) {
    using std::abs;
    is_to_change_ = change.has_value();
    T shorter = length;
    if (change) {
      const T size = abs(time);
      const T least = std::numeric_limits<T>::epsilon() * (size < length ? length : size) *
                      T(std::ldexp(1.0, std::min(instants_, 20)));
      if (*change < length) shorter = *change;
      if (shorter < least) shorter = least;
      if (length < shorter) shorter = length;
    }
    instants_ = shorter < length * T(0x1p-20) ? instants_ + 1 : 0;
    return shorter;
  }
  /// One that leads to no change.
  void take_none() { is_to_change_ = false; }

  /// Whether the step leads to a change.
  bool is_to_change() const { return is_to_change_; }
  /// Whether its length is next to none.
  bool is_instant() const { return instants_ > 0; }
  /// Whether 100 of them have come in a row: the motion slides along a jump of the force or chatters about it.
  bool is_stuck() const { return instants_ >= 100; }

 private:
  bool is_to_change_ = false;
  int instants_ = 0;
};

}  // namespace jetlag
