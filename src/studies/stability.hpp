// SPDX-License-Identifier: MIT
#pragma once
// `jetlag stability`: where series stopped at a random degree are stable, as a table and a picture.

#include "studies/studies.hpp"

namespace jetlag {

void add_stability(CLI::App& app, std::optional<Study>& chosen);

}  // namespace jetlag
