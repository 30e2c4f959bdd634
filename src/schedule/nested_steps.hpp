// SPDX-License-Identifier: MIT
#pragma once
// Steps that nest, none of them long enough to resonate.

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"

namespace jetlag {

/// The shortest step h times powers of two, within the limit of leapfrog,  2^l h omega < 2,  omega a
/// bound of all frequencies: the fastest motion may be due to elements of the longest step alone; and with  (2^l h)
/// omega_h <= most,  omega_h = 2/h asin(h omega / 2).  Without the second bound that is 2^(l+1) asin(h omega / 2) < 2 pi/3
/// for l > 0.
class NestedSteps {
 public:
  /// omega: a bound of the fastest frequency [rad/s]; shortest: h [s]. Throws std::invalid_argument where it is beyond 2/omega, and where no element has a stiffness.
  NestedSteps(double omega, double shortest, double most = std::numeric_limits<double>::infinity())
      : shortest_(shortest), longest_(shortest) {
    if (omega == 0)
      throw std::invalid_argument(
          "without_resonance: no element has a stiffness, so that no frequency is known");
    if (!(shortest * omega < 2))
      throw std::invalid_argument("without_resonance: the shortest step is " + shown(shortest) +
                                  "; must be below 2/omega = " + shown(2 / omega));
    const double omega_h = 2 / shortest * std::asin(shortest * omega / 2);
    while (2 * longest_ * omega_h <= most && 2 * longest_ * omega < 2) longest_ *= 2;
  }

  /// The longest of them that is not longer than `step`.
  double operator()(double step) const {
    double nested = shortest_;
    while (2 * nested <= std::min(step, longest_)) nested *= 2;
    return nested;
  }

 private:
  double shortest_, longest_;
};

}  // namespace jetlag
