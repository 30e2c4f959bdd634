// SPDX-License-Identifier: MIT
#pragma once
// One particle, or two with a spring between them.

#include <array>

#include "problems/problem.hpp"

namespace jetlag::problems {

/// x'' = -omega^2 x on a line, from x and v.
Problem oscillator(double omega = 1.0, double x = 1.0, double v = 0.0);

/// Round a circle of radius 1 at angular speed omega: the size of every derivative is constant.
Problem circular_oscillator(double omega = 1.0);

/// A pendulum in its angle: x'' = -sin x, at rest at 1.3.
Problem pendulum();

/// One particle thrown into a uniform field: x = x_0 + v_0 t + g t^2 / 2.
Problem free_fall();

/// Two masses on a line, a spring of rest length 1 between them, stretched by 0.2: as long as the masses do
/// not pass each other the motion is linear, of frequency sqrt(k (1/m_0 + 1/m_1)).
Problem dumbbell(double stiffness, double mass_0, double mass_1);

/// A unit mass in the field of HenonHeiles, from q with p.
Problem henon_heiles(const std::array<double, 2>& q, const std::array<double, 2>& p);

/// A unit mass on a spring of stiffness 1 and length 1 to a fixed one at the origin, at (1, 0) with the velocity
/// (-1.2, delta): it passes the origin at the distance 1.5 delta, where the force turns round in an instant.
Problem collapsing_spring(double delta);

/// A unit mass dropped from 1 m onto a floor of 1e4 N/m, ten times.
Problem bounces();

/// The equations of Lorenz from (-10, -1, 40), as forces.
Problem lorenz_motion();

}  // namespace jetlag::problems
