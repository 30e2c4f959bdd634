// SPDX-License-Identifier: MIT
#pragma once
// Bodies that attract each other.

#include <vector>

#include "problems/problem.hpp"

namespace jetlag::problems {

/// All pairs attract each other with that constant of gravity.
System<double> attracting(int dimension, const std::vector<double>& mass, double constant = 1.0);

/// A planet round a fixed sun (particle 0) at the origin: semi-major axis 1, period 2 pi, eccentricity e, from the
/// pericentre. The energy is -1/2. Steps are searched from a period / 14.8 on: no small multiple of it is a period.
Problem planet(double e);

/// A planet, e = 0.6, in a field with delta = 0.015 of PerturbedKepler: angular momentum 0.8.
Problem perturbed_planet();

/// Two bodies of masses 1 and 3, `distance` apart at rest. They meet after time_of_collision(distance).
Problem falling_together(double distance);
double time_of_collision(double distance);

/// Two bodies of masses 3 and 1, G = 1, on an ellipse inclined to all axes.
Problem inclined_pair();

/// A light body on a planar orbit of eccentricity 1/2 about a heavy one, G = 1.
Problem light_body();

/// Masses 3, 4, 5 at the corners of a triangle, from rest.         Source: Burrau 1913; Szebehely, Peters 1967.
Problem three_bodies();

/// Three equal masses that follow each other on an eight.         Source: Chenciner, Montgomery 2000.
Problem figure_eight();

/// Seven bodies in the plane, until 3.         Source: [HLW06], I.5; Hairer, Norsett, Wanner, II.10.
Problem pleiades();

/// The Sun with the inner planets, Jupiter, Saturn, Uranus, Neptune and Pluto; astronomical units and days.
/// Source: [HLW06] I.2.4, heliocentric positions and velocities of September 5, 1994.
Problem outer_solar_system(int bodies = 6);

/// Equal bodies of mass 1 in all, drawn in the unit cube, at rest; each attracts each with the constant 1.
Problem bodies_at_rest(int bodies);

/// The closed orbit with four loops near the earth and the moon, in axes that turn with them, for one period.
Problem arenstorf_orbit();

}  // namespace jetlag::problems
