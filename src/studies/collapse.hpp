// SPDX-License-Identifier: MIT
#pragma once
// A spring that collapses within a body: who takes small steps, and who is ruined by a step that is too long.

#include "studies/studies.hpp"

namespace jetlag {

void add_collapse(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
