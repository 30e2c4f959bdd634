// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/leapfrog.hpp"

namespace jetlag {

Leapfrog::Leapfrog(const System<double>& system, double step) : OneStep(system, 2), step_(step) {
  require_positive("step", step);
}

double Leapfrog::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  const double h = fixed_length(from, step_, limit, report);
  if (h == 0.0 || !accelerations_(from, a_before_, report)) return 0.0;
  to.time = from.time + h;
  to.position = from.position + h * from.velocity + 0.5 * h * h * a_before_;
  to.velocity = from.velocity + h * a_before_;
  if (!all_finite(to.position, to.velocity, from.time, report) || !accelerations_(to, a_after_, report))
    return 0.0;
  to.velocity = from.velocity + 0.5 * h * (a_before_ + a_after_);
  return h;
}

Piece Leapfrog::piece() const {
  return {before().time,
          before().time + length(),
          {before().position, before().velocity, 0.5 * a_before_},
          {before().velocity, a_before_, (a_after_ - a_before_) / (2.0 * length())}};
}

}  // namespace jetlag
