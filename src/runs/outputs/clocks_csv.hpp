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
  void end(const RecordedRun& run, const RunResult& result) override {
    write_clocks_csv(run.folder / file(), *result.clocks);
  }
};

}  // namespace jetlag
