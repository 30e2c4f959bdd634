// SPDX-License-Identifier: MIT
#include "jetlag/base/outcome.hpp"

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
  }
  return "unknown";
}

}  // namespace jetlag
