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
// No promises. On nonlinear forces in steps that do not resolve them the energy is not bounded, as with Newmark's,
// and sooner for m > 1: two unit masses 1.2 m apart on a spring of 1 m and 1e6 N/m, turning at 0.1 m/s, dt = 0.01 s,
// change their energy in 1 s by 0.7 % at m = 1 and by 460 % at m = 2 (at dt = 0.001 s by 5e-7 and 3e-7). And the centre
// of mass of coarse and fine particles follows their momentum only to O(h^2), since the velocity of only the fine ones
// swings within a cycle: without the turning it goes to and fro by dt^2 F / 4 kg = 5 m at m = 2, F = 2e5 N.
//
// Cost of a cycle: twice or more, once for each iteration of Newton's method, m factorisations of the sparse fine
// matrix and m (1 + i) solves with it, i the moving components of the interface; and a factorisation of a coarse matrix
// that is dense in the i. The responses are dense and kept through the cycle: memory 8 m f i bytes, f the fine
// components; with what is in work about 8 ((m + 6) f (1 + i) + 8 i^2 + 2 (m + 1) n), n all components. So it is made
// for an interface that is small beside the fine part, and not for coarse and fine particles mixed at random: a cloth
// of 40 x 40 particles, half of them coarse (f = 2484, i = 2208), at m = 2 takes 11 s and 620 MB for one cycle.

#include <vector>

#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

class SubcyclingSolver;

class ImplicitSubcycling final : public OneStep {
 public:
  struct Options {
    double step = 0;  // dt, of fine particles [s], > 0; a step of the integrator is a cycle of ratio * step
    int ratio = 1;    // m >= 1; a cycle that is cropped to h takes ceil(h / dt) equal substeps
    std::vector<int> coarse;  // particles; all others are fine. Fixed ones among them do not count.
  };

  /// Throws std::invalid_argument for a step or ratio out of range, and for a coarse particle that does not exist or is
  /// named twice; and for a ratio and an interface with which a cycle would need more than 2 GiB.
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
