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

#include <vector>

#include "jetlag/schedule/impulses.hpp"

namespace jetlag {

/// A step for each particle [s]; those of fixed ones do not count.
using ParticleSteps = std::vector<double>;

/// fraction * 2 / omega for each particle by its own bound of the frequency (`frequency_bounds`). Particles without a
/// stiffness get the longest step of the others. fraction: in (0, 1].
/// Throws std::invalid_argument for another fraction, and where no particle has a stiffness.
ParticleSteps courant_steps_of_particles(const System<double>& system, double fraction);

class Subcycling final : public Impulses {
 public:
  /// steps: > 0 and finite, one for each particle. Particles of equal steps share a clock.
  /// Throws std::invalid_argument for steps of another shape, and for forces that depend on velocities: those of the
  /// particles are half a step behind, each by its own.
  Subcycling(const System<double>& system, const ParticleSteps& steps);
};

}  // namespace jetlag
