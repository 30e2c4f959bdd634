// SPDX-License-Identifier: MIT
#pragma once
// What a random degree adds to second moments of a state in one step, in closed form and from the coefficients that a
// control reads anyway: methods with `own_series` need order N + 1 of the positions, those with `derivative` order N.

#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"

namespace jetlag {

/// Variances of the components after a step; shapes (particles, dimension).
struct StateVariance {
  Coordinates<double> position;  // [m^2]
  Coordinates<double> velocity;  // [m^2/s^2]
};

/// For a step of length h [s] from the beginning of the series. The same for one draw or one for each particle. A
/// sequential law has it given the terms: pass law.given(sizes). Throws std::invalid_argument for a series that is too
/// short.
StateVariance state_variance(const Expansion<double>& series, const TruncationLaw& law, double h,
                             VelocitySeries velocity = VelocitySeries::own_series);

/// The energy a step adds in the mean, E H(y+) - H(E y+) [J], where all particles share the draw:
///
///     sum_{n=m+1..N} (w_n - w_{n-1}) (T(S_n) + S_n . U'' S_n / 2),   T: kinetic energy, U'': at E y+,
///
/// S_n the tail sums of velocities and positions (of single-term laws: see random_part). Exact for quadratic U, where
/// it is the mean of H over draws; otherwise the first term of an expansion in the S_n. U'' by a second difference of U
/// over tail sums stretched to 1e-4 of the largest coordinate, exact to some 1e-7.
/// Cost: 2 (N - m) energies. Throws std::invalid_argument for a series that is too short.
double random_energy(const System<double>& system, const Expansion<double>& series, const TruncationLaw& law,
                     double h, VelocitySeries velocity = VelocitySeries::own_series);

}  // namespace jetlag
