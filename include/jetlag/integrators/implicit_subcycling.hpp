// SPDX-License-Identifier: MIT
#pragma once
// Implicit subcycling: the trapezoidal rule with long steps for some particles and short ones for the others.
//
//      coarse   o---------------------------------o       one cycle: h = m dt
//      fine     o---o---o---o---o---o---o---o---o---o     m steps of dt
//
// Sources: P. Smolinski, Y.-S. Wu, Comput. Mech. 22 (1998); A. Gravouil, A. Combescure, IJNME 50 (2001) 199;
// A. Prakash, K. Hjelmstad, IJNME 61 (2004) 2183.
//
// The first has a nodal partition, Newmark's method with beta = 1/4 and gamma = 1/2 in both parts, the coarse motion
// interpolated to the substeps, one implicit solve for each part and step of its own. The others gave stable forms of
// it: subdomains that are first moved freely and then linked by forces on their interface.
//
// Here the interface are the coarse particles that share an element with a fine one. Coarse positions and velocities
// are linear in time over a cycle, so that a fine step sees
//      x_c(t_j) = x_0 + j/m (x_m - x_0),     v_c(t_j) = v_0 + j/m (v_m - v_0),
// and what such an element does to a coarse particle is the mean over the cycle of what it does in the fine steps:
//      M_f (v_{j+1} - v_j) = dt/2 (F_f(t_j) + F_f(t_{j+1})),     x_{j+1} = x_j + dt/2 (v_j + v_{j+1}),
//      M_c (v_m - v_0) = h/2 (F_cc(0) + F_cc(h)) + dt sum_j 1/2 (F_cf(t_j) + F_cf(t_{j+1})),
//      x_m = x_0 + h/2 (v_0 + v_m).
// Solved as there: the fine part is moved freely, with its response to a change of the interface beside it; the
// coarse equations condensed with that response give the change; it is added. That is Newton's method on the whole
// cycle with exact Jacobians from the tapes; on linear forces one pass solves it, and a second one tells so.
//
// Why not multipliers on split masses. With these, velocities agree at the ends of cycles but displacements part: the
// interface has two positions, energy dissipates (Gravouil, Combescure) or only a pseudo-energy of accelerations is
// conserved (Prakash, Hjelmstad). Interpolated displacements keep one position, and the very work that a fine element
// does on the interface in each substep, F_mean . (x_m - x_0) / m, is what the coarse particle receives.
//
// Promises. On linear forces the energy is conserved to rounding for any dt and m: unconditionally stable, no bands of
// resonance. Symmetric, of order 2, linear momentum conserved to rounding. m = 1 is Newmark's method. Forces that
// depend on velocities or time are welcome. What is not resolved: frequencies above 1/h of coarse particles, 1/dt of
// fine ones.
//
// Cost of a cycle: twice or more, m factorisations of the fine matrix and m (interface components) solves with it.

#include <vector>

#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

class SubcyclingSolver;

class ImplicitSubcycling final : public OneStep {
 public:
  struct Options {
    double step = 0;  // dt, of fine particles [s], > 0; a step of the integrator is a cycle of ratio * step
    int ratio = 1;    // m >= 1
    std::vector<int> coarse;  // particles; all others are fine. Fixed ones among them do not count.
  };

  /// Throws std::invalid_argument for a step or ratio out of range, and for a coarse particle that does not exist or is
  /// named twice.
  ImplicitSubcycling(const System<double>& system, Options options);
  ~ImplicitSubcycling() override;

  /// Positions and velocities on lines between the ends of the cycle: the substeps are not in it. Errors within it are
  /// O(h^2), as those of the method over a run. Where the energy is convex it is nowhere above that of the higher end;
  /// cubics through the same states would take stiff springs that are not resolved to many times their length.
  Piece piece() const override;

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;

  Options options_;
  std::unique_ptr<SubcyclingSolver> solver_;
};

}  // namespace jetlag
