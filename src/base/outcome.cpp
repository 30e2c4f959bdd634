// SPDX-License-Identifier: MIT
#include "jetlag/base/outcome.hpp"

#include "jetlag/base/text.hpp"

namespace jetlag {

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::success: return "success";
    case Outcome::step_underflow: return "step_underflow";
    case Outcome::non_finite: return "non_finite";
    case Outcome::step_limit: return "step_limit";
    case Outcome::interrupted: return "interrupted";
    case Outcome::not_converged: return "not_converged";
    case Outcome::event: return "event";
    case Outcome::contradicted: return "contradicted";
  }
  return "unknown";
}

Report step_limit(std::uint64_t max_steps, double time, const std::string& advice) {
  return {Outcome::step_limit,
          "the largest number of steps, " + std::to_string(max_steps) + ", is used up at t = " + shown(time) +
              "; allow more or " + advice,
          -1};
}

Report interrupted(double time) { return {Outcome::interrupted, "stopped at t = " + shown(time), -1}; }

}  // namespace jetlag
