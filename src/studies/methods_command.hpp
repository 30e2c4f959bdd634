// SPDX-License-Identifier: MIT
#pragma once
// `jetlag methods`: the pages of all methods.

#include "studies/studies.hpp"

namespace jetlag {

void add_methods(CLI::App& app, std::optional<Study>& chosen);

}  // namespace jetlag
