// SPDX-License-Identifier: MIT
#pragma once
// The complete scene, so that the run can be repeated.

#include "jetlag/output/files.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

class SceneJson final : public Output {
 public:
  std::string file() const override { return "scene.json"; }
  void begin(const RecordedRun& run) override { write_file(run.folder / file(), run.scene.json + "\n"); }
};

}  // namespace jetlag
