// SPDX-License-Identifier: MIT
#include "jetlag/model/finite.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "jetlag/base/text.hpp"

namespace jetlag {

bool all_finite(const Coordinates<double>& position, const Coordinates<double>& velocity, double begin,
                Report& report) {
  const int bad = std::max(first_not_finite(position), first_not_finite(velocity));
  if (bad < 0) return true;
  report = {Outcome::non_finite,
            "the state after the step from t = " + shown(begin) + " is not finite at particle " +
                std::to_string(bad) +
                ": the step is too long for this motion; take a shorter step or a control",
            bad};
  return false;
}

bool in_range(const State<double>& state, double largest, double begin, Report& report) {
  // A sum of squares is the fastest way to see them all; it fails before any of them is as large, never after.
  if (state.position.squaredNorm() + state.velocity.squaredNorm() < largest * largest) return true;
  for (int i = 0; i < state.position.rows(); ++i)
    for (const auto& [rows, of] : {std::pair(&state.position, "position"), {&state.velocity, "velocity"}})
      if (!(rows->row(i).cwiseAbs().maxCoeff() < largest)) {
        report = {Outcome::non_finite,
                  "the " + std::string(of) + " of particle " + std::to_string(i) +
                      " after the step from t = " + shown(begin) + " is beyond " + shown(largest) +
                      ", where squares overflow: the motion has blown up; take a shorter step or a smaller "
                      "tolerance",
                  i};
        return false;
      }
  return true;
}

}  // namespace jetlag
