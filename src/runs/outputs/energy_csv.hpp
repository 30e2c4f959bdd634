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
  void frame(const RecordedRun& run, const Frame&, const RunResult& so_far) override {
    if (growth_.is_due(so_far.energies.size()))
      write_energy_csv(run.folder / file(), so_far.energies, Until::handed_over);
  }
  void end(const RecordedRun& run, const RunResult& result) override {
    write_energy_csv(run.folder / file(), result.energies);
  }

 private:
  ListGrowth growth_{1. / 32};
};

}  // namespace jetlag
