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
    const std::string what = "coefficient " + std::to_string(k) + " of the motion of particle " +
                             std::to_string(bad) + " is not finite at t = " + shown(series.time());
    const char* why =
        k > 2
            ? ": the force on it has no series there (a norm or root of what is zero?), or the motion has "
              "blown up; start beside that point, write the force so that it is smooth or take a shorter step"
            : ": the force is singular there (particles that coincide?), or the motion has blown up; "
              "separate the particles, soften the force or take a shorter step";
    report = {Outcome::non_finite, what + why, bad};
    return false;
  }
  return true;
}

}  // namespace jetlag
