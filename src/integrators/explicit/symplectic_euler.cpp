// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/symplectic_euler.hpp"

#include <stdexcept>

namespace jetlag {

SymplecticEuler::SymplecticEuler(const System<double>& system, double step)
    : OneStep(system, 1), step_(step) {
  require_positive("step", step);
  if (accelerations_.depend_on_velocity())
    throw std::invalid_argument(
        "symplectic_euler: a force depends on velocities (drag), and there is no symplectic method for it");
}

double SymplecticEuler::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  const double h = fixed_length(from, step_, limit, report);
  Coordinates<double> a;
  if (h == 0.0 || !accelerations_(from, a, report)) return 0.0;
  to.velocity = from.velocity + h * a;
  to.position = from.position + h * to.velocity;
  return h;
}

Piece SymplecticEuler::piece() const {
  const double h = length();
  return {before().time,
          before().time + h,
          {before().position, after().velocity},
          {before().velocity, (after().velocity - before().velocity) / h}};
}

}  // namespace jetlag
