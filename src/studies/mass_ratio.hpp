// SPDX-License-Identifier: MIT
#pragma once
// A heavy mass and a light one that shakes it: how many updates each takes, and what becomes of the energy.

#include "studies/studies.hpp"

namespace jetlag {

void add_mass_ratio(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
