// SPDX-License-Identifier: MIT
#pragma once
// Work against error: every way of stopping a series, on the same problems.

#include "studies/studies.hpp"

namespace jetlag {

void add_speed_against_error(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
