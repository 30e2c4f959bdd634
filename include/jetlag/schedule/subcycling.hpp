// SPDX-License-Identifier: MIT
#pragma once
// Subcycling: every particle has a step of its own; those with long steps are seen on straight lines by the others.
//
//     fine particles    |---|---|---|---|---|---|---|---|     a = F / m where all are now, v += h a, x += h v
//     coarse particles  |-----------|-----------|--------     constant velocity in between
//
// Sources: T. Belytschko, H.-J. Yen, R. Mullen, Mixed methods for time integration, Comput. Methods Appl. Mech. Eng. 17/18
// (1979) 259: steps with a whole ratio; M. Neal, T. Belytschko, Explicit-explicit subcycling with non-integer time step
// ratios for structural dynamic systems, Comput. Struct. 31 (1989) 871: any ratio, a clock for each particle. It is one
// method: steps in a whole ratio ring together. With one step for all it is leapfrog.
//
// Promises: order 2. For steps in whole ratios the map of a cycle is symmetric: it runs backwards through the same states.
// Not symplectic, and momentum is conserved to the order of the method only: the ends of an element on two clocks get its
// force at different times. Where an element has a potential, `Avi` keeps both.
//
// Resonance. Below the limits h < 2/omega of each clock there are bands of steps in which the motion grows, narrow ones
// where two frequencies add up to a multiple of 2 pi / H, H the time in which the clocks repeat; real ratios have them
// too. On a chain wall-100-A-1-B-1-wall of unit masses, B four times slower: .12684 < h < .12761, by 1.1 % a cycle.
// `without_resonance` keeps out of them: for two clocks by proof, for more by experience.

#include <vector>

#include "jetlag/schedule/impulses.hpp"

namespace jetlag {

/// A step for each particle [s]; those of fixed ones do not count.
using ParticleSteps = std::vector<double>;

/// fraction * 2 / omega for each particle by its own bound of the frequency (`frequency_bounds`). Particles without a
/// stiffness get the longest step of the others. fraction: in (0, 1].
/// Throws std::invalid_argument for another fraction, and where no particle has a stiffness.
ParticleSteps courant_steps_of_particles(const System<double>& system, double fraction);
/// The same for all laws, at a state: steps of a clock do not change, so that the fraction is also the room for laws that
/// stiffen. Throws std::invalid_argument also as `frequency_bounds` at a state.
ParticleSteps courant_steps_of_particles(const System<double>& system, const State<double>& state,
                                         double fraction);

/// Steps without resonance: each becomes the shortest one, h, times a power of two, not longer than it was and with
///     (2^l h) omega_h <= pi / 2,     omega_h = 2/h asin(h omega / 2),     omega = frequency_bound(system).
/// omega_h bounds every frequency of motion in steps of h: no step is longer than a quarter of the fastest period.
///
/// Why that is stable, for linear forces and two clocks, h and H = m h. The cycle is symmetric in time, so that positions
/// at the beginnings of cycles obey  X_{n+1} + X_{n-1} = 2 S X_n: stable if S has eigenvalues in (-1, 1) and is
/// diagonalizable. With K the stiffness over masses, A fine and B coarse, cos(alpha) = 1 - h^2 K_AA / 2, theta = m alpha
/// and Q = (1 - sin(theta) / (m sin(alpha))) / K_AA, S is in the coordinates (x_A + Q K_AB x_B, x_B)
///     cos(theta)          -W K_AB                                W = (1 - cos(theta)) (1 / K_AA - Q)
///     -H^2/2 K_BA         1 - H^2/2 (K_BB - K_BA Q K_AB)
/// (functions of the matrix K_AA). Where sin(theta) > 0 for all its frequencies, W > 0, and S is similar to a symmetric
/// matrix: no two frequencies can feed each other. 1 - S > 0 because K is; 1 + S > 0 if
///     K_BB + K_BA G K_AB < 4 / H^2,     G = (2 tan(theta/2) / (m sin(alpha)) - 1) / K_AA,
/// which follows from  m tan(alpha/2) tan(m alpha/2) < 1  at alpha = h omega_h: true up to theta = pi/2, for all m > 1.
/// For more than two nested clocks no proof is known to us; tests find no exception. Ratios of 1 are what is left where h
/// is beyond a quarter period already: for longer steps take `ExplicitImplicit`.
/// Throws std::invalid_argument where the shortest step is itself beyond 2/omega, and where no element has a stiffness.
ParticleSteps without_resonance(const System<double>& system, ParticleSteps steps);
/// The same with the bound of all laws at a state.
ParticleSteps without_resonance(const System<double>& system, const State<double>& state,
                                ParticleSteps steps);

class Subcycling final : public Impulses {
 public:
  /// steps: > 0 and finite, one for each particle. Particles of equal steps share a clock.
  /// Throws std::invalid_argument for steps of another shape, and for forces that depend on velocities: those of the
  /// particles are half a step behind, each by its own.
  Subcycling(const System<double>& system, const ParticleSteps& steps);
};

}  // namespace jetlag
