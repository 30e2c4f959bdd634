// SPDX-License-Identifier: MIT
#include "studies/studies.hpp"

namespace jetlag {

std::vector<Command> studies() {
  return {paper_table_study(), paper_figures_study(),       reference_problems_study(), kepler_study(),
          brouwer_study(),     speed_against_error_study(), hard_cases_study(),         ruler_study(),
          collapse_study(),    avi_drift_study(),           mass_ratio_study()};
}

}  // namespace jetlag
