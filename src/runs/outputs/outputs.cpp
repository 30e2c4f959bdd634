// SPDX-License-Identifier: MIT
// The register of outputs.
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

/// Pictures come last: they take seconds, and energy.svg is drawn from energy.csv.
std::vector<std::unique_ptr<Output>> all_outputs() {
  return made<SummaryJson, SceneJson, EnergyCsv, ClocksCsv, FramesVtu, EnergySvg, ClocksSvg, FilmPng>();
}

std::vector<std::filesystem::path> files_of(const Output& output, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files = output.other_files(folder);
  if (std::filesystem::exists(folder / output.file())) files.insert(files.begin(), output.file());
  return files;
}

std::vector<std::filesystem::path> first_files_of_run(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& output : all_outputs())
    if (std::filesystem::exists(folder / output->file())) files.push_back(folder / output->file());
  return files;
}

}  // namespace jetlag
