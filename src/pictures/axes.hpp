// SPDX-License-Identifier: MIT
#pragma once
// What charts with axes have in common, in the language of gnuplot.

#include <string>

#include "pictures/colours.hpp"

namespace jetlag::axes {

/// Colours of borders, tics, grid and key; numbers come separated by commas.
extern const std::string style;

/// An axis label ("xlabel", "ylabel").
std::string label(const std::string& what, const std::string& text);

std::string heading(const std::string& title);

}  // namespace jetlag::axes
