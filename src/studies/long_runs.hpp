// SPDX-License-Identifier: MIT
#pragma once
// Planets over thousands of periods: how many steps they take, and how rounding adds up.

#include "studies/studies.hpp"

namespace jetlag {

/// `study kepler` and `study brouwer`.
void add_long_runs(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
