// SPDX-License-Identifier: MIT
#pragma once
// `jetlag ensemble`: a scene run many times at once, and what the members amount to.

#include "studies/studies.hpp"

namespace jetlag {

void add_ensemble(CLI::App& app, std::optional<Study>& chosen);

}  // namespace jetlag
