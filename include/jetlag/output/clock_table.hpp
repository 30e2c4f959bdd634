// SPDX-License-Identifier: MIT
#pragma once
// Who was updated when: the clocks of a run as a table.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "jetlag/output/files.hpp"
#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

/// Keeps the updates of a run, in the order in which it is told about them, and the last step and degree of each particle.
/// At most `most_rows` are kept: of longer runs every second, fourth, ... update of each particle, counted from its first.
class ClockTable {
 public:
  static constexpr std::size_t most_rows = 100'000;

  /// Updates of fixed particles are not kept.
  explicit ClockTable(std::vector<bool> fixed);

  void add(const Update& update);

  const std::vector<Update>& rows() const { return rows_; }
  /// Every how many updates of a particle one is kept: a power of two.
  std::uint64_t stride() const { return stride_; }

  /// Of each particle the step [s], 0 before its first update, and the degree.
  const std::vector<double>& step() const { return step_; }
  const std::vector<int>& degree() const { return degree_; }

 private:
  void thin_out();

  std::vector<bool> fixed_;
  std::vector<std::uint64_t> updates_;  // of each particle, so far
  std::vector<Update> rows_;
  std::uint64_t stride_ = 1;
  std::vector<double> step_;
  std::vector<int> degree_;
};

/// particle,time,step,degree: one line for each update that was kept; time [s] is when the step begins.
void write_clocks_csv(const std::filesystem::path& path, const ClockTable& clocks,
                      Until until = Until::on_disk);

}  // namespace jetlag
