// SPDX-License-Identifier: MIT
#pragma once
// The motion in one picture.

#include "runs/outputs/picture.hpp"

namespace jetlag {

/// Keeps all frames of a small scene, evenly spaced ones of a large one, and the last.
class FilmPng final : public Picture {
 public:
  std::string file() const override { return "film.png"; }

  void begin(const RecordedRun& run) override {
    const Scene& scene = run.scene;
    const double numbers = 2.0 * scene.shape.particles * scene.shape.dimension * (scene.output.frames + 1);
    stride_ = std::max(1, static_cast<int>(numbers / 4e6));
    stride_ = std::min(stride_, std::max(1, scene.output.frames / 12));
  }
  void frame(const RecordedRun&, const Frame& frame, const RunResult&) override {
    if (count_++ % stride_ == 0)
      frames_.push_back(frame);
    else
      last_ = frame;
  }

 private:
  void draw(const RecordedRun& run, const RunResult&) const override {
    auto frames = frames_;
    if (last_.time > frames.back().time) frames.push_back(last_);
    draw_film(run.folder / file(), run.scene.shape, frames, run.scene.name);
  }

  int stride_ = 1, count_ = 0;
  std::vector<Frame> frames_;
  Frame last_;
};

}  // namespace jetlag
