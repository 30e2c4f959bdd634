// SPDX-License-Identifier: MIT
#pragma once
// Outcome, last state, energy, momentum and cost of a run.

#include "jetlag/output/files.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

class SummaryJson final : public Output {
 public:
  std::string file() const override { return "summary.json"; }
  Turn turn() const override { return Turn::summary; }
  void end(const RecordedRun& run, const RunResult& result) override {
    write_file(run.folder / file(), to_json(result.summary));
  }
};

}  // namespace jetlag
