// SPDX-License-Identifier: MIT
#pragma once
// What methods are tried on: a system, where it starts, and what is known of where it ends. A problem is one function of
// this room, called by tests, benchmarks and studies.

#include <optional>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag::problems {

struct Problem {
  System<double> system;
  State<double> start;
  double until = 0;                             // [s]; 0: to be chosen
  std::optional<Coordinates<double>> end = {};  // positions at `until` [m]
  double end_error = 0;     // of `end`, root mean square over the particles that move [m]; 0: its rounding
  double largest_step = 0;  // where a search for a fixed step begins [s]; 0: to be chosen
  std::vector<int> stiff = {},
                   slow = {};  // particles that methods in two parts treat so; empty: to be chosen
  std::string name = {}, description = {};
};

/// All particles at the origin, at rest.
State<double> at_origin(const System<double>& system);

/// The number of all elements.
std::size_t element_count(const System<double>& system);

/// Whether every element has an energy, so that their sum with the kinetic one is kept.
bool conserves_energy(const System<double>& system);

/// sqrt(mean_i |x_i - y_i|^2) over the particles that are not fixed [m].
double distance(const System<double>& system, const Coordinates<double>& x, const Coordinates<double>& y);

}  // namespace jetlag::problems
