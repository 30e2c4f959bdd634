// SPDX-License-Identifier: MIT
#pragma once
// The initial value problems of reference_problems.hpp against their known end values.

#include "studies/studies.hpp"

namespace jetlag {

void add_reference_table(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
