// SPDX-License-Identifier: MIT
#pragma once
// The classical Runge-Kutta method, and Euler's, on which others build.

#include "jetlag/integrators/explicit/runge_kutta.hpp"

namespace jetlag {

/// Order 4, four force evaluations a step; neither symplectic nor symmetric.   Source: Kutta 1901; [HNW93] II.1.
const RungeKuttaTable& rk4();

/// y_1 = y_0 + h f(y_0). Order 1, one force evaluation a step.   Source: Euler 1768.
const RungeKuttaTable& euler();

}  // namespace jetlag
