// SPDX-License-Identifier: MIT
#pragma once
// The energies and their error against time.

#include "runs/outputs/energy_csv.hpp"
#include "runs/outputs/picture.hpp"

namespace jetlag {

class EnergySvg final : public Picture {
 public:
  std::string file() const override { return "energy.svg"; }
  bool is_wanted(const OutputOptions& asked) const override { return asked.pictures && asked.energy; }

 private:
  void draw(const RecordedRun& run, const RunResult&) const override {
    draw_energy(run.folder / EnergyCsv().file(), run.folder / file(), run.scene.name);
  }
};

}  // namespace jetlag
