// SPDX-License-Identifier: MIT
#pragma once
// Frames for ParaView and everything else that reads VTK's XML files.

#include <filesystem>
#include <string>
#include <vector>

#include "jetlag/output/files.hpp"
#include "jetlag/output/shape.hpp"

namespace jetlag {

/// One frame as an UnstructuredGrid. Points are in space: missing components are 0. Cells are the tetrahedra;
/// the lines where there are none; else the triangles of the surface; else a vertex for each particle; and the triangles and
/// edges of obstacles. Point data: velocity [m/s] (3 components) and fixed (0 or 1), and where the frame has them step [s] and
/// degree, gap [m] (-1 for none) and contact_force [N] (3 components); field data: TimeValue [s].
///
/// Numbers are plain text in the shortest form that keeps every bit. Base64 would take 11 bytes a number
/// instead of some 19, but text can be read, searched and compared by anybody and knows no byte order.
/// Throws std::invalid_argument for a frame that does not fit or is not finite; std::runtime_error as
/// write_file.
void write_vtu(const std::filesystem::path& path, const Shape& shape, const Frame& frame);

/// The list that makes a film of frames: files[i], named relative to `path`, is shown at times[i] [s].
void write_pvd(const std::filesystem::path& path, const std::vector<double>& times,
               const std::vector<std::string>& files, Until until = Until::on_disk);

}  // namespace jetlag
