// SPDX-License-Identifier: MIT
#include "jetlag/output/clock_table.hpp"

#include "jetlag/base/text.hpp"

namespace jetlag {

ClockTable::ClockTable(std::vector<bool> fixed)
    : fixed_(std::move(fixed)), updates_(fixed_.size()), step_(fixed_.size()), degree_(fixed_.size()) {}

void ClockTable::add(const Update& update) {
  const int i = update.particle;
  if (fixed_[i]) return;
  step_[i] = update.step;
  degree_[i] = update.degree;
  if (updates_[i]++ % stride_ != 0) return;
  if (rows_.size() == most_rows) thin_out();
  if ((updates_[i] - 1) % stride_ == 0) rows_.push_back(update);
}

/// Every second row of each particle goes.
void ClockTable::thin_out() {
  stride_ *= 2;
  std::vector<bool> keep(fixed_.size(), false);
  std::erase_if(rows_, [&](const Update& row) {
    keep[row.particle] = !keep[row.particle];
    return !keep[row.particle];
  });
}

void write_clocks_csv(const std::filesystem::path& path, const ClockTable& clocks, Until until) {
  std::string table = "particle,time,step,degree\n";
  for (const Update& row : clocks.rows())
    table += std::to_string(row.particle) + ',' + number(row.begin) + ',' + number(row.step) + ',' +
             std::to_string(row.degree) + '\n';
  write_file(path, table, until);
}

}  // namespace jetlag
