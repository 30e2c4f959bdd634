// SPDX-License-Identifier: MIT
#pragma once
// Motions that break methods, whose ends are known to more digits than a double has.

#include <vector>

#include "problems/problem.hpp"

namespace jetlag::problems {

/// Names begin with H1 to H11; the description is what is difficult.
std::vector<Problem> hard_cases();

}  // namespace jetlag::problems
