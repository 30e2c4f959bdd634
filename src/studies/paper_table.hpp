// SPDX-License-Identifier: MIT
#pragma once
// The paper's table of eight runs of a soft body, with numbers in place of its videos.

#include "studies/studies.hpp"

namespace jetlag {

void add_paper_table(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
