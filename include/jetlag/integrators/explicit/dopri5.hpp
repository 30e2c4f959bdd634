// SPDX-License-Identifier: MIT
#pragma once
// The method of Dormand and Prince of order 5(4).

#include "jetlag/integrators/explicit/runge_kutta.hpp"

namespace jetlag {

/// Order 5 with an estimate by the embedded method of order 4; seven stages, the last of which is the first of the next
/// step: six force evaluations a step.   Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19; [HNW93] II.5,
/// table 5.2.
const RungeKuttaTable& dopri5();

}  // namespace jetlag
