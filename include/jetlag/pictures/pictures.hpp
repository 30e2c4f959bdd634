// SPDX-License-Identifier: MIT
#pragma once
// Pictures of a run and of an ensemble, drawn by gnuplot where it is installed.
//
// All throw std::runtime_error when gnuplot is missing or fails, with its message, and as write_file does;
// std::invalid_argument for a picture that is neither .png nor .svg, and for frames that do not fit the
// shape.

#include <filesystem>
#include <string>
#include <vector>

#include "jetlag/output/shape.hpp"

namespace jetlag {

class ClockTable;
struct EnsembleResult;

/// Whether gnuplot is in one of the folders of PATH.
bool can_draw();

/// The table of write_energy_csv: energies above, relative error below, against time.
void draw_energy(const std::filesystem::path& csv, const std::filesystem::path& picture,
                 const std::string& title);

/// The motion in one picture; what it shows depends on the shape:
///   a surface in space     snapshots of the shaded body, coloured by speed;
///   lines                  snapshots of the springs, coloured by strain relative to the first frame;
///   up to 10 particles     their orbits, fading into the past;
///   more                   snapshots of the particles, coloured by speed;
///   on a line              positions against time.
/// Snapshots are evenly spaced in the list of frames, include the first and the last, and share one scale.
/// In space shape.up points up.
void draw_film(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
               const std::string& title);

/// A row for each particle, of large scenes for a hundred of them; in it a bar for each step that was kept, long steps
/// cool, short ones warm, on a logarithmic scale.
void draw_clocks(const std::filesystem::path& picture, const ClockTable& clocks, double until,
                 const std::string& title);

/// Above, the band of one quantity (5 to 95 %, 25 to 75 %), its median and the reference, or where the band is less than
/// a fiftieth of what it moves, all minus the reference. Below, Calibration against time. .svg or .png, by gnuplot.
void draw_ensemble(const std::filesystem::path& picture, const EnsembleResult& result, std::size_t watched,
                   const std::string& title);

}  // namespace jetlag
