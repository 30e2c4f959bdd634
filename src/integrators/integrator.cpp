// SPDX-License-Identifier: MIT
#include "jetlag/integrators/integrator.hpp"

#include "jetlag/base/text.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag {

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

bool all_finite(const Expansion<double>& series, Report& report) {
  for (int k = 0; k <= series.order(); ++k) {
    const int bad = first_not_finite(series.position(k));
    if (bad < 0) continue;
    report = {
        Outcome::non_finite,
        "coefficient " + std::to_string(k) + " of the motion of particle " + std::to_string(bad) +
            " is not finite at t = " + shown(series.time()) + ": " + cause_of_no_coefficient(k) +
            ", or the motion has blown up; start beside that place, soften the force or take a shorter step",
        bad};
    return false;
  }
  return true;
}

}  // namespace jetlag
