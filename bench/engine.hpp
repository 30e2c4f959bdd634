// SPDX-License-Identifier: MIT
#pragma once
// The table of `./run bench engine`: what is measured, beside the goals set for it.

#include <iosfwd>
#include <optional>
#include <string>

namespace jetlag::bench {

inline constexpr int engine_degrees[] = {8, 16, 32, 64};
inline constexpr int engine_sides[] = {14, 42, 130, 410};  // cloths of 1e3, 1e4, 1e5, 1e6 springs

class Reporter;

/// Prints the rows that were measured in this run; nothing if none was.
void print_engine(const Reporter& reporter, std::ostream& out);

}  // namespace jetlag::bench
