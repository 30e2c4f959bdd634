// SPDX-License-Identifier: MIT
#pragma once
// The figures of the paper, with numbers beside them.

#include "studies/studies.hpp"

namespace jetlag {

void add_paper_figures(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
