// SPDX-License-Identifier: MIT
#pragma once
// The energies at the frames.

#include "jetlag/output/energy_table.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

class EnergyCsv final : public Output {
 public:
  std::string file() const override { return "energy.csv"; }
  bool is_wanted(const OutputOptions& asked) const override { return asked.energy; }
  void end(const RecordedRun& run, const RunResult& result) override {
    write_energy_csv(run.folder / file(), result.energies);
  }
};

}  // namespace jetlag
