// SPDX-License-Identifier: MIT
#pragma once
// How a step or a run ended. Events of a computation are values; exceptions are for misuse.

#include <cstdint>
#include <string>

namespace jetlag {

enum class Outcome {
  success,
  step_underflow,  // the step no longer changes the time
  non_finite,      // a coefficient or the new state is infinite or NaN
  step_limit,      // the caller's largest number of steps is used up
  interrupted,     // the caller asked to stop
  not_converged,   // the equations of an implicit step are not solved
  event,           // a terminal event has ended the run
  contradicted,    // the forces at the end of a step that cannot be taken again are not those that it foresaw
};

const char* to_string(Outcome outcome);

/// An outcome, and for all but success where it happened and what to do about it, in a sentence.
struct Report {
  Outcome outcome = Outcome::success;
  std::string message;
  int particle = -1;        // the first particle concerned, if any
  std::uint64_t steps = 0;  // that a run took, one that failed at its end perhaps among them
};

/// The reports of a run that has used up its steps, and of one that was asked to stop. time: of its last state [s].
Report step_limit(std::uint64_t max_steps, double time, const std::string& advice = "take longer steps");
Report interrupted(double time);

}  // namespace jetlag
