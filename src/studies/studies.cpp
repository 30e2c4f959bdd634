// SPDX-License-Identifier: MIT
#include "studies/studies.hpp"

#include "studies/avi_drift.hpp"
#include "studies/collapse.hpp"
#include "studies/hard_cases.hpp"
#include "studies/long_runs.hpp"
#include "studies/mass_ratio.hpp"
#include "studies/paper_figures.hpp"
#include "studies/paper_table.hpp"
#include "studies/reference_table.hpp"
#include "studies/ruler_table.hpp"
#include "studies/speed_against_error.hpp"
#include "studies/stability.hpp"

namespace jetlag {

void add_studies(CLI::App& app, std::optional<Study>& chosen) {
  auto* study = app.add_subcommand("study", "make a table from many runs");
  study->require_subcommand(1);
  add_paper_table(*study, chosen);
  add_paper_figures(*study, chosen);
  add_reference_table(*study, chosen);
  add_long_runs(*study, chosen);
  add_speed_against_error(*study, chosen);
  add_hard_cases(*study, chosen);
  add_stability(app, chosen);
  add_ruler_table(*study, chosen);
  add_collapse(*study, chosen);
  add_avi_drift(*study, chosen);
  add_mass_ratio(*study, chosen);
}

}  // namespace jetlag
