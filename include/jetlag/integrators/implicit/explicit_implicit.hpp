// SPDX-License-Identifier: MIT
#pragma once
// Explicit and implicit particles in one step: leapfrog for most, Newmark's method for the few that are stiff.
//
//     explicit    x_1 = x_0 + h v_0 + h^2/2 a_0                 beta = 0
//     implicit    x_1 = x_0 + h v_0 + h^2/4 (a_0 + a_1)         beta = 1/4, solved by Newton's method
//     both        v_1 = v_0 + h/2 (a_0 + a_1)                   gamma = 1/2
//
// a_1 of all particles is that of all new positions. Forces that depend on velocities enter with v_1 for both kinds, by
// the trapezoidal rule: then all particles are unknowns.
//
// Source: T. Belytschko, R. Mullen, Stability of explicit-implicit mesh partitions in time integration, Int. J. Numer.
// Methods Eng. 12 (1978) 1575.
//
// Promises: order 2, symmetric. For linear forces the energy oscillates and does not drift, and it is stable exactly for
//     h < 2 / omega_E,
// omega_E the fastest frequency of the explicit particles while the implicit ones are held (the largest eigenvalue of
// K_EE over the masses is its square): however stiff what acts on implicit particles only, it does not matter, and no
// step resonates.

#include <vector>

#include "jetlag/integrators/implicit/implicit.hpp"

namespace jetlag {

/// The particles that cannot be explicit with steps h [s]: those with h omega_i >= 2 by their own bound of the frequency
/// (`frequency_bounds`), and not fixed. For linear forces the others are then stable. Shape (particles).
std::vector<bool> beyond_courant(const System<double>& system, double step);
/// The same for all laws, at a state. Throws std::invalid_argument as `frequency_bounds` at a state.
std::vector<bool> beyond_courant(const System<double>& system, const State<double>& state, double step);

class ExplicitImplicit final : public ImplicitMethod {
 public:
  /// step [s], > 0; implicit: which particles are, shape (particles). Throws std::invalid_argument.
  ExplicitImplicit(const System<double>& system, double step, const std::vector<bool>& implicit);

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;

  Eigen::VectorXd quarter_;  // beta = 1/4 of implicit particles, 0 of others
};

}  // namespace jetlag
