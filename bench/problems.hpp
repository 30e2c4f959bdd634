// SPDX-License-Identifier: MIT
#pragma once
// The problems on which the benchmarks run, by their names.

#include <string>

#include "problems/problem.hpp"

namespace jetlag::bench {

using problems::element_count;
using problems::Problem;

/// cloth<side>, bodies<number>, kepler, planar_kepler, solar, sun_jupiter_saturn, planet, pendulum, henon_heiles.   Throws std::invalid_argument.
Problem problem(const std::string& name);

}  // namespace jetlag::bench
