// SPDX-License-Identifier: MIT
#pragma once
// Meshes: read from a file or generated.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

struct Mesh {
  Coordinates<double> position;  // [m], shape (vertices, dimension)
  std::vector<std::array<int, 4>> tetrahedra;
  std::vector<std::array<int, 3>>
      triangles;  // of a plane mesh or a sheet; for a body, see boundary() in output/shape.hpp
  std::vector<std::array<int, 2>> edges;  // distinct, a < b, sorted
  std::vector<std::string> warnings;      // of the file: it can be used, but may not be what was meant
};

/// The distinct edges of tetrahedra and triangles, a < b, sorted.
std::vector<std::array<int, 2>> edges_of(const std::vector<std::array<int, 4>>& tetrahedra,
                                         const std::vector<std::array<int, 3>>& triangles);

/// Six times the signed volume of a tetrahedron (1-0) x (2-0) . (3-0).
double six_volumes(const Coordinates<double>& position, const std::array<int, 4>& tetrahedron);

/// A tetrahedral mesh in Medit's ASCII format (.mesh). Sections other than Vertices and Tetrahedra, whatever they are called,
/// are passed over up to the next word; words may be in any case, numbers as in C or Fortran, also whole ones with a point.
/// Coordinates too small for double are 0. Tetrahedra of negative volume are turned round, with one warning; another one
/// names vertices that are in no tetrahedron.
/// Throws SceneError naming file and line: missing file, truncated sections, indices out of range, coordinates that are not
/// finite, tetrahedra with a vertex twice or without volume, lines longer than 100000 characters, a lack of memory.
Mesh read_medit(const std::filesystem::path& file);

/// A surface in Wavefront's format (.obj): its vertices and faces, of more than three corners as fans about the first; lines of
/// anything else are passed over. Warnings name vertices that are in no face and such that are where another one is.
/// Throws SceneError as above.
Mesh read_wavefront(const std::filesystem::path& file);

/// An ellipsoid cut by two planes, filled with tetrahedra.
/// radii [m] along x, y, z; cells: number of cubes across (even) in x and z, and along y, each of 6 tetrahedra;
/// lower, upper: the cuts, as fractions of radius y, in (0, 1).
Mesh truncated_ellipsoid(std::array<double, 3> radii, std::array<int, 2> cells, double lower, double upper);

/// An ellipse cut by two lines, filled with triangles: the plane section of the above.
Mesh truncated_ellipse(std::array<double, 2> radii, std::array<int, 2> cells, double lower, double upper);

/// The box [0, lengths] in cells, each cut into six tetrahedra along (1, 1, 1): Kuhn's mesh. lengths [m], > 0; cells, >= 1.
/// Vertex (i (n_y + 1) + j)(n_z + 1) + k stands at (i, j, k) cells. The tetrahedra of a cell are next to each other; a mesh of
/// cells half as long is cut along the faces of this one.
/// Throws std::invalid_argument.    Source: H. Kuhn, Some combinatorial lemmas in topology, IBM J. 4 (1960) 518.
Mesh box(const std::array<double, 3>& lengths, const std::array<int, 3>& cells);

/// The same in the plane: two triangles a cell, cut along (1, 1).
Mesh rectangle(const std::array<double, 2>& lengths, const std::array<int, 2>& cells);

/// The sphere about the origin: an icosahedron each of whose edges is cut into so many `cells`, its 20 cells^2 triangles turning
/// left when seen from outside. radius [m], > 0; cells, >= 1. Throws std::invalid_argument for others.
Mesh geodesic_sphere(double radius, int cells);

/// Points spacing [m] apart, counts[d] of them along axis d (1, 2 or 3 axes), in a space of `dimension`.
/// Edges join neighbours along the axes; with `cloth` also along the diagonals (shear) and over two (bend).
Mesh regular_grid(const std::vector<int>& counts, double spacing, int dimension, bool cloth);

/// How a sheet is cut into triangles. Bent by a curvature along an angle phi to x, the energy of `Bending` and of small angles
/// of `Hinge`, over that of a plate, is (40 x 40 cells; 1 but for the borders would be right):
///
///     phi [degrees]                                      0      22.5   45     90     135
///     equilateral  rows shifted by half a cell           1.00   1.00   1.00   0.99   1.00
///     crisscross   diagonals that alternate (union jack) 0.99   1.25   1.51   0.99   1.51
///     uniform      all diagonals along (1, 1)            0.99   2.20   3.00   0.99   1.02
///
/// The latter two are of right-angled triangles, and do not come nearer with more of them: take the first one where bending
/// matters.
enum class SheetPattern { equilateral, crisscross, uniform };

/// A sheet in space at z = 0, its vertices at cells of lengths / cells from (0, 0): two triangles a cell, counterclockwise as
/// seen from above. Vertex (i, j) has the number i (cells[1] + 1) + j. Every second row (odd j) of an equilateral sheet is
/// shifted by half a cell along x, and stands out by that at the right; triangles are equilateral where cells are sqrt(3)/2
/// as high as wide.
/// lengths [m], > 0; cells, >= 1. Throws std::invalid_argument for others.
Mesh sheet(std::array<double, 2> lengths, std::array<int, 2> cells, SheetPattern pattern);

}  // namespace jetlag
