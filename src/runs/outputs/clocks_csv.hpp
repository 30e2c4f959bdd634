// SPDX-License-Identifier: MIT
#pragma once
// Who was updated when.

#include "jetlag/output/clock_table.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

class ClocksCsv final : public Output {
 public:
  std::string file() const override { return "clocks.csv"; }
  bool is_wanted(const OutputOptions& asked) const override { return asked.clocks; }
  void frame(const RecordedRun& run, const Frame&, const RunResult& so_far) override {
    const ClockTable& clocks = *so_far.clocks;
    if (growth_.is_due(clocks.rows().size() * clocks.stride()))
      write_clocks_csv(run.folder / file(), clocks, Until::handed_over);
  }
  void end(const RecordedRun& run, const RunResult& result) override {
    write_clocks_csv(run.folder / file(), *result.clocks);
  }

 private:
  ListGrowth growth_{1. / 2};  // 30 ms for the longest of these tables
};

}  // namespace jetlag
