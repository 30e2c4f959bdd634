// SPDX-License-Identifier: MIT
#pragma once
// The table of accuracy as a file in markdown: one row for each function, no date, no machine.

#include <string>

namespace jetlag::accuracy {

/// The whole file table.md, over the corners of the domains and that many draws for each function.
std::string table(int draws);

}  // namespace jetlag::accuracy
