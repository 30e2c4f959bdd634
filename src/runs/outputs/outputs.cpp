// SPDX-License-Identifier: MIT
// The register of outputs.
#include "jetlag/output/files.hpp"
#include "jetlag/runs/run_ensemble.hpp"
#include "runs/outputs/clocks_csv.hpp"
#include "runs/outputs/clocks_svg.hpp"
#include "runs/outputs/energy_csv.hpp"
#include "runs/outputs/energy_svg.hpp"
#include "runs/outputs/film_png.hpp"
#include "runs/outputs/frames_vtu.hpp"
#include "runs/outputs/scene_json.hpp"
#include "runs/outputs/summary_json.hpp"

namespace jetlag {

namespace {

template <class... Outputs>
std::vector<std::unique_ptr<Output>> made() {
  std::vector<std::unique_ptr<Output>> outputs;
  (outputs.push_back(std::make_unique<Outputs>()), ...);
  return outputs;
}

}  // namespace

std::vector<std::unique_ptr<Output>> all_outputs() {
  return made<SummaryJson, SceneJson, EnergyCsv, ClocksCsv, FramesVtu, EnergySvg, ClocksSvg, FilmPng>();
}

std::vector<std::filesystem::path> files_of(const Output& output, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files = output.other_files(folder);
  if (std::filesystem::exists(folder / output.file())) files.insert(files.begin(), output.file());
  return files;
}

void remove_earlier_results(const std::filesystem::path& folder) {
  const auto remove = [&](const std::filesystem::path& name) {
    if (name != SceneJson().file()) std::filesystem::remove(folder / name);
  };
  for (const char* name : ensemble_files) remove(name);
  for (const auto& output : all_outputs()) {
    for (const auto& file : files_of(*output, folder)) remove(file);
    const std::filesystem::path within = std::filesystem::path(output->file()).parent_path();
    if (within.empty()) continue;
    sweep_drafts(folder / within);
    std::error_code stays;  // where there is something of somebody else's in it
    if (!std::filesystem::is_symlink(folder / within)) std::filesystem::remove(folder / within, stays);
  }
}

std::vector<std::filesystem::path> first_files_of_run(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& output : all_outputs())
    if (std::filesystem::exists(folder / output->file())) files.push_back(folder / output->file());
  return files;
}

}  // namespace jetlag
