// SPDX-License-Identifier: MIT
#pragma once
// Asynchronous variational integrator: every element has a clock of its own and pushes its particles when that rings.
//
//     element 0   |-------|-------|-------|-------|-------|      an impulse -h_K grad V_K at each bar
//     element 1   |---|---|---|---|---|---|---|---|---|---|
//     element 2   |------------|------------|------------|       in between, particles move on straight lines
//
// Source: A. Lew, J. Marsden, M. Ortiz, M. West, Asynchronous variational integrators, Arch. Rational Mech. Anal. 167
// (2003) 85: the discrete Euler-Lagrange equations of an action whose potential energy is sampled element by element.
// With one step for all it is leapfrog.
//
// Promises: order 2; linear momentum to rounding, angular momentum for forces along the line between two particles; an
// energy that oscillates and does not drift, unless steps resonate.
//
// Resonance. An impulse every H of a soft element feeds an oscillation of frequency omega where omega H is just below a
// multiple of pi, however small its stiffness k:
//     omega H in (n pi - 2 atan(H k / (2 omega)), n pi)     for unit mass and an exact oscillation between impulses.
// Other ratios of steps have narrower bands. `without_resonance` keeps out of them.

#include <vector>

#include "jetlag/schedule/impulses.hpp"

namespace jetlag {

/// Steps of all elements [s]: one list for each group of System::elements(), in its order.
using ElementSteps = std::vector<std::vector<double>>;

/// One step for all.
ElementSteps equal_steps(const System<double>& system, double step);

/// Throws std::invalid_argument naming a force without a potential energy in the positions, which avi does not integrate.
void require_potentials(const System<double>& system);

/// fraction * 2 / omega_K, the share of its own Courant limit, for each element whose law bounds its stiffness k:
///     omega_K^2 = k sum_{i of it} 1/m_i.     Fixed particles count as infinitely heavy.
/// A constant force limits no step: it takes the shortest of those on the same particle, or where there is none the
/// longest of all. fraction: in (0, 1].
/// Throws std::invalid_argument for another fraction, for a law that neither bounds its stiffness nor is constant, and
/// where no element has a stiffness.
ElementSteps courant_steps(const System<double>& system, double fraction);
/// The same where elements of laws without a stiffness take fraction * 2 / omega_e at a state (control/frequency_bound.hpp),
/// omega_e as fast as the whole may be where they are: with up to 24 tetrahedra at a particle, the limit of one alone is of
/// no use. Steps of a clock do not change. Throws std::invalid_argument also as `frequency_bounds` at a state.
ElementSteps courant_steps(const System<double>& system, const State<double>& state, double fraction);

/// Steps meant to resonate with no oscillation of the system: each becomes the shortest one, h, times a power of two, not
/// longer than it was and with
///     2^l h omega < 2,     omega = frequency_bound(system).
/// omega_h = 2/h asin(h omega / 2) bounds every frequency of motion in steps of h. Clocks that nest repeat every
/// H = 2^l h, the longest step, and a periodic linear Hamiltonian motion loses its stability only where two of its
/// frequencies (or one, twice) add up to a multiple of 2 pi / H (M. Krein 1950; V. Arnold, Mathematical Methods of
/// Classical Mechanics, app. 3 and 25 D): below omega_h H = pi none do, and H omega < 2 keeps it below 2 pi/3. The soft
/// elements shift the frequencies that h alone would give; pi/3 is left for that. H omega < 2 is itself needed for a fast
/// motion that is all due to elements of the step H: a hub on many soft springs. Measured, not proved: no exception in
/// millions of random systems of two and three nested clocks.
/// Forces without a bound on their stiffness are not covered. Throws std::invalid_argument where the shortest step is
/// itself beyond 2/omega, and where no element has a stiffness.
ElementSteps without_resonance(const System<double>& system, ElementSteps steps);
/// The same with the bound of all laws at a state.
ElementSteps without_resonance(const System<double>& system, const State<double>& state, ElementSteps steps);

class Avi final : public Impulses {
 public:
  /// steps: > 0 and finite; see above. Elements of equal steps share a clock and run together.
  /// Throws std::invalid_argument for steps of another shape, and for a law that is not the gradient of a potential
  /// energy in the positions alone.
  Avi(const System<double>& system, const ElementSteps& steps);
};

}  // namespace jetlag
