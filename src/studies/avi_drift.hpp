// SPDX-License-Identifier: MIT
#pragma once
// The energy of asynchronous variational integrators over long runs: it wavers and does not drift.

#include "studies/studies.hpp"

namespace jetlag {

void add_avi_drift(CLI::App& study, std::optional<Study>& chosen);

}  // namespace jetlag
