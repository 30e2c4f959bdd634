// SPDX-License-Identifier: MIT
#pragma once
// Who was updated when, a row for each particle.

#include "runs/outputs/picture.hpp"

namespace jetlag {

class ClocksSvg final : public Picture {
 public:
  std::string file() const override { return "clocks.svg"; }
  bool is_wanted(const OutputOptions& asked) const override { return asked.pictures && asked.clocks; }

 private:
  void draw(const RecordedRun& run, const RunResult& result) const override {
    draw_clocks(run.folder / file(), *result.clocks, run.scene.until, run.scene.name);
  }
};

}  // namespace jetlag
