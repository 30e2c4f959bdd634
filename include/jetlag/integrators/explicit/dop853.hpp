// SPDX-License-Identifier: MIT
#pragma once
// The method of Dormand and Prince of order 8(5,3).

#include "jetlag/integrators/explicit/runge_kutta.hpp"

namespace jetlag {

/// Order 8, twelve force evaluations a step. Its error is estimated by methods of order 5 and 3 together,
/// e = e_5 e_5 / sqrt(e_5^2 + e_3^2 / 100), which falls as h^8.
/// Source: Dormand, Prince; [HNW93] II.5 and II.10, with the coefficients of Hairer's dop853.f.
const RungeKuttaTable& dop853();

}  // namespace jetlag
