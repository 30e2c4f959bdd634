// SPDX-License-Identifier: MIT
#pragma once
// What the pictures of a run have in common: they need gnuplot, and a run is none the worse for a lack of them.

#include <algorithm>
#include <stdexcept>

#include "jetlag/pictures/pictures.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

/// Calls draw() where gnuplot is there. What went wrong becomes a warning, unless it is one already.
template <class Draw>
void draw_or_warn(std::vector<std::string>& warnings, const Draw& draw) {
  std::string warning = "gnuplot is not installed: no pictures are drawn";
  if (can_draw()) {
    try {
      return draw();
    } catch (const std::runtime_error& error) {
      warning = error.what();
    }
  }
  if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(std::move(warning));
}

class Picture : public Output {
 public:
  bool is_wanted(const OutputOptions& asked) const override { return asked.pictures; }
  Turn turn() const final { return Turn::picture; }
  void end(const RecordedRun& run, const RunResult& result) final {
    draw_or_warn(run.warnings, [&] { draw(run, result); });
  }

 private:
  virtual void draw(const RecordedRun& run, const RunResult& result) const = 0;
};

}  // namespace jetlag
