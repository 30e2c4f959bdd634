// SPDX-License-Identifier: MIT
#pragma once
// How the errors of a planet grow with fixed degrees and with random ones, by kind of draw.

#include "studies/studies.hpp"

namespace jetlag {

void add_ruler_table(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
