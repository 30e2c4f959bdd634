// SPDX-License-Identifier: MIT
#include "jetlag/integrators/integrator.hpp"

#include <algorithm>
#include <utility>

#include "jetlag/base/text.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

namespace {

/// The first row with an entry that is not finite; -1 when there is none.
template <class M>
int first_not_finite(const M& rows) {
  if (rows.allFinite()) return -1;
  for (int i = 0; i < rows.rows(); ++i)
    if (!rows.row(i).allFinite()) return i;
  return -1;
}

}  // namespace

Report step_underflow(const Expansion<double>& series, double h) {
  int fastest = -1;
  if (series.particles() > 0) series.velocity(0).rowwise().squaredNorm().maxCoeff(&fastest);
  return {
      Outcome::step_underflow,
      "step " + shown(h) + " at t = " + shown(series.time()) + " no longer changes the time; particle " +
          std::to_string(fastest) +
          " is the fastest: particles collide, a tolerance is too small or the time too large; soften the " +
          "force, loosen the tolerance or count the time from a later origin",
      fastest};
}

int moving_particles(const System<double>& system) {
  return static_cast<int>(std::ranges::count(system.fixed(), false));
}

bool all_finite(const Coordinates<double>& position, const Coordinates<double>& velocity, double time,
                Report& report) {
  const int bad = std::max(first_not_finite(position), first_not_finite(velocity));
  if (bad < 0) return true;
  report = {Outcome::non_finite,
            "the state after the step from t = " + shown(time) + " is not finite at particle " +
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

bool all_finite(const Expansion<double>& series, Report& report) {
  for (int k = 0; k <= series.order(); ++k) {
    const int bad = first_not_finite(series.position(k));
    if (bad < 0) continue;
    report = {Outcome::non_finite,
              "coefficient " + std::to_string(k) + " of the motion of particle " + std::to_string(bad) +
                  " is not finite at t = " + shown(series.time()) +
                  ": the force is singular there (particles that coincide?), or the motion has blown up; "
                  "separate the "
                  "particles, soften the force or take a shorter step",
              bad};
    return false;
  }
  return true;
}

}  // namespace jetlag
