// SPDX-License-Identifier: MIT
#pragma once
// Masses in a row.

#include <vector>

#include "problems/problem.hpp"

namespace jetlag::problems {

/// wall - k_0 - m_1 - k_1 - m_2 .. [- k_n - wall], linear springs: displacements. Particle 0 is the first wall.
Problem line(const std::vector<double>& mass, const std::vector<double>& stiffness);

/// Wall, springs of rest length 1 and the given stiffnesses with unit masses between them, wall; at rest.
Problem chain_between_walls(const std::vector<double>& stiffness);

/// Two unit masses between walls, linear springs 100, 1, 1; from (1, -1/2) at rest, until 1000.
Problem resonant_chain();

/// wall - 1 N/m - 1 kg - 1 N/m - 1e-6 kg, until 100. The light mass runs a thousand times as fast as the heavy one, and
/// shakes it by a millionth of its own amplitude: by 1e-9 m at 1000 a second.
Problem light_mass();
inline constexpr double fast_frequency = 1000.0005000003749998125;  // of light_mass [1/s]

/// wall - 1 N/m - 1 kg - 1e6 N/m - 1 kg, until 100. Both masses are equally fast and equally far out: there is nothing to
/// be saved.
Problem stiff_spring();

/// `moving` unit masses between two walls (particles 0 and moving + 1), cubic springs, at displacements of two long waves, at
/// rest; four springs in the middle are stiffer.         Source: methods 15b, with 128 masses.
Problem stiff_spot_in_a_chain(int moving, double ratio);

/// 32 masses between walls, springs d + d^3, until 496. Source: the beta chain of Fermi, Pasta, Ulam, Tsingou 1955.
Problem fput();

/// 32 masses between walls, springs d + d^2/4, one arch of a sine, until 100. Source: the alpha chain, likewise.
Problem fput_alpha();

/// Six masses between walls, stiff linear and soft cubic springs in turn, until 10.         Source: [HLW06] I.5.
Problem stiff_and_soft_springs();

/// Ten free unit masses on a line, hardening springs of 1 and 100 in turn, velocities 0.1 sin(1 + i^2) shifted to the
/// mean 0.05. Energy 0.040064470729897, momentum 0.5.         Source: methods 8.
Problem ten_masses();

/// At which all clocks of courant_steps(ten_masses().system, f) ring: steps of its stiff springs are a tenth of those of
/// the soft ones [s].
double common_period_of_ten_masses(double f);

}  // namespace jetlag::problems
