// SPDX-License-Identifier: MIT
#pragma once
// The picture of a comparison: error against work and against time, both on scales of powers of ten.

#include <filesystem>
#include <string>
#include <vector>

namespace jetlag {

struct WorkPrecision {
  std::string family;
  double error, work, seconds;
};

/// Every run is a dot; the line of a family joins those that no other of its runs beats in both error and work.
/// floor: errors below it are those of the reference. ceiling: runs of larger errors are left out. Throws as draw_energy.
void draw_work_precision(const std::filesystem::path& picture, const std::string& title,
                         const std::vector<WorkPrecision>& points, double floor, double ceiling);

}  // namespace jetlag
