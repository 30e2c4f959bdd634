// SPDX-License-Identifier: MIT
#pragma once
// Every method on motions that break methods: who survives, with what error, for how much work.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/hard_cases.hpp"

namespace jetlag {

/// A method with its settings, as in a scene file. "step" is filled in where there is one.
struct HardMethod {
  std::string name;
  nlohmann::ordered_json integrator, control, schedule;
  bool has_step = false;
  std::string
      part;  // a list of the integrator that is filled in: "implicit", stiff particles; "coarse", slow ones
};
std::vector<HardMethod> hard_methods();

struct HardResult {
  enum class Verdict {
    accurate,  // to a tenth of the extent of the motion, at least
    wrong,     // it ended, elsewhere
    failed,    // it said why
    slow,      // it was stopped
    refused    // it does not integrate such a motion, and said why
  } verdict;
  double error = 0;  // of the positions, in extents of the motion
  double energy_error =
      0;  // relative to the largest of kinetic and potential energy at the beginning; NaN: none
  double evaluations = 0;  // element coefficients for each element: a force evaluation is one
  double seconds = 0;      // of the processor
  std::string message;
};

/// evaluations: what a method with a fixed step may spend. limit [s]: of the processor.
HardResult run_hard_case(const problems::Problem& hard, const HardMethod& method, double evaluations,
                         double limit);

}  // namespace jetlag
