// SPDX-License-Identifier: MIT
#pragma once
// Edges that pass through a surface.

#include <vector>

#include "jetlag/contact/surface.hpp"

namespace jetlag {

/// Throws std::invalid_argument for an edge that passes through a triangle or, in the plane, through another edge, unless all of
/// them are fixed or body (empty: none) is the same for both.
void require_no_crossing(const Surface& surface, const std::vector<bool>& fixed, const std::vector<int>& body,
                         const Coordinates<double>& position);

}  // namespace jetlag
