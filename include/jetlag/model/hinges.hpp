// SPDX-License-Identifier: MIT
#pragma once
// Where the triangles of a surface meet.

#include <array>
#include <vector>

namespace jetlag {

/// The inner edges x_0 x_1 of a surface, x_0 < x_1, in ascending order, each with the vertices opposite to it: x_2 of the
/// triangle that is passed round from x_0 to x_1, x_3 of the other. The participants of Bending and Hinge.
/// Throws std::invalid_argument naming what is no surface with two sides: an edge in three triangles or more, two triangles
/// that are passed round in opposite senses, a triangle that has a vertex twice or a negative one.
std::vector<std::array<int, 4>> hinges_of(const std::vector<std::array<int, 3>>& triangles);

}  // namespace jetlag
