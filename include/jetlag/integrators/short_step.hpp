// SPDX-License-Identifier: MIT
#pragma once
// Steps of Taylor's method from a singular point: where the series of a particle has its first coefficients only, as that of a
// motion from rest with a force |v| v. They are so short that these suffice.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "jetlag/integrators/step_check.hpp"

namespace jetlag {

/// Where forces are looked at within a step from a singular point, in parts of it: they may come back to what they were.
inline constexpr std::array looks_within_a_step{0.0625, 0.21, 0.38, 0.52, 0.62, 0.815, 0.94};

/// Whether a step h from a singular point is short enough: forces are those to which its series leads but for
///
///     h |a - x''|  <=  8 eps V,      V = max(|v|, h |a|) of the longest step from which on h |a - x''| is no more:
///
/// a speed that the motion reaches before it has become another one, so that what the velocities are off is below the
/// rounding of what they become. Where nothing moves nor is pushed at the beginning, 2^-72 of the h |a - x''| that was seen
/// first, or any in 64 places of the time: a push that grows from nothing, as t^(3/2), is felt after a part of the way that
/// the step was to go, 2^-29 of it there, and a max_step makes it less.
class ShortStepBound {
 public:
  bool allows(const StepDefect& defect) {
    if (!std::isfinite(defect.force)) return false;
    const double off = defect.force / defect.step;
    if (defect.force > defect.begun)
      speed_ = 0;
    else if (speed_ == 0)
      speed_ = defect.begun / defect.step;
    if (unseen_ == 0 && defect.begun == 0) unseen_ = 0x1p-72 * off;
    if (defect.begun == 0 &&
        defect.step <= 64 * std::numeric_limits<double>::epsilon() * std::abs(defect.time))
      return true;
    return off <= std::max(8 * std::numeric_limits<double>::epsilon() * speed_, unseen_);
  }

 private:
  double speed_ = 0, unseen_ = 0;  // V, and the part of what was seen first [m/s]
};

}  // namespace jetlag
