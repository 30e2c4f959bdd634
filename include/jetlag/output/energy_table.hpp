// SPDX-License-Identifier: MIT
#pragma once
// The energy of a run as a table.

#include <filesystem>
#include <vector>

#include "jetlag/model/energy.hpp"
#include "jetlag/output/files.hpp"

namespace jetlag {

struct EnergyRow {
  double time = 0;            // [s]
  Energy energy;              // [J]
  double relative_error = 0;  // [1], of the total
};

/// Columns: time,kinetic,potential,total,relative_error. A field is empty where its number is not finite.
/// Throws std::runtime_error as write_file.
void write_energy_csv(const std::filesystem::path& path, const std::vector<EnergyRow>& rows,
                      Until until = Until::on_disk);

}  // namespace jetlag
