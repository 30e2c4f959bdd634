// SPDX-License-Identifier: MIT
// The energy of a run as a table of comma-separated values.
#include "jetlag/output/energy_table.hpp"

#include <cmath>

#include "jetlag/base/text.hpp"

namespace jetlag {

void write_energy_csv(const std::filesystem::path& path, const std::vector<EnergyRow>& rows, Until until) {
  std::string table = "time,kinetic,potential,total,relative_error\n";
  for (const auto& [time, energy, relative_error] : rows)
    table += field(time) + ',' + field(energy.kinetic) + ',' + field(energy.potential) + ',' +
             field(energy.total()) + ',' + field(relative_error) + '\n';
  write_file(path, table, until);
}

}  // namespace jetlag
