// SPDX-License-Identifier: MIT
#pragma once
// Studies: tables made by running many scenes. To add one, write its file and add its line here and in studies.cpp.

#include <vector>

#include "command_line/command.hpp"

namespace jetlag {

/// All of them, in the order of their list.
std::vector<Command> studies();

/// The paper's table of eight runs of a soft body, with numbers in place of its videos; and its figures.
Command paper_table_study();
Command paper_figures_study();

/// The initial value problems of reference_problems.hpp against their known end values.
Command reference_problems_study();

/// Planets over thousands of periods: how many steps they take, and how rounding adds up.
Command kepler_study();
Command brouwer_study();

/// Work against error: every way of stopping a series, on the same problems.
Command speed_against_error_study();

/// Every method on motions that break methods.
Command hard_cases_study();

/// How the errors of a planet grow with fixed degrees and with random ones, by kind of draw.
Command ruler_study();

/// A spring that collapses within a body: who takes small steps, and who is ruined by a step that is too long.
Command collapse_study();

/// The energy of asynchronous variational integrators over long runs: it wavers and does not drift.
Command avi_drift_study();

/// A heavy mass and a light one that shakes it: how many updates each takes, and what becomes of the energy.
Command mass_ratio_study();

}  // namespace jetlag
