// SPDX-License-Identifier: MIT
#pragma once
// The frames for ParaView: a file for each, and a list of them.

#include <algorithm>

#include "jetlag/output/vtu.hpp"
#include "runs/outputs/output.hpp"

namespace jetlag {

class FramesVtu final : public Output {
 public:
  std::string file() const override { return "frames/run.pvd"; }

  bool is_wanted(const OutputOptions& asked) const override { return asked.frames > 0; }

  std::vector<std::filesystem::path> other_files(const std::filesystem::path& folder) const override {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::is_directory(folder / "frames")) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames"))
      if (is_frame(entry.path().filename().string())) files.push_back("frames" / entry.path().filename());
    std::ranges::sort(files);
    return files;
  }

  void begin(const RecordedRun& run) override { std::filesystem::create_directories(run.folder / "frames"); }
  void frame(const RecordedRun& run, const Frame& frame, const RunResult&) override {
    names_.push_back(frame_name(names_.size()));
    times_.push_back(frame.time);
    write_vtu(run.folder / "frames" / names_.back(), run.scene.shape, frame);
    if (growth_.is_due(names_.size())) write_pvd(run.folder / file(), times_, names_, Until::handed_over);
  }
  void end(const RecordedRun& run, const RunResult&) override {
    write_pvd(run.folder / file(), times_, names_);
  }

 private:
  static std::string frame_name(std::size_t number) {
    const std::string digits = std::to_string(number);
    return "frame_" + std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits + ".vtu";
  }
  /// Whether a name is one that frame_name gives: nothing else is ever removed.
  static bool is_frame(const std::string& name) {
    const std::string digits = name.size() > 10 ? name.substr(6, name.size() - 10) : "";
    return !digits.empty() && digits.size() <= 9 &&
           digits.find_first_not_of("0123456789") == std::string::npos &&
           name == frame_name(std::stoul(digits));
  }

  std::vector<double> times_;  // [s]
  std::vector<std::string> names_;
  ListGrowth growth_{1. / 32};
};

}  // namespace jetlag
