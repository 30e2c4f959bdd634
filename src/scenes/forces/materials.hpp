// SPDX-License-Identifier: MIT
#pragma once
// Of what elements of solids and of cloth are made.

#include <cstddef>
#include <string>
#include <vector>

#include "jetlag/forces/solids/lame.hpp"
#include "scenes/choices.hpp"
#include "scenes/keys.hpp"
#include "scenes/reader.hpp"

namespace jetlag {

struct Material {
  std::vector<Lame<double>> elastic, viscous;  // [Pa], [Pa s]: of each element
  double thickness = 1;                        // [m]
};

/// "young" and "poisson", or "lame" [Pa], of each of `count` elements.
std::vector<Lame<double>> read_lame(const Value& force, std::size_t count,
                                    std::vector<std::string>& warnings);

/// "damping_time" [s] or "viscosity" [Pa s], of each element.
std::vector<Lame<double>> read_viscosity(const Value& force, const std::vector<Lame<double>>& elastic);

/// "thickness" [m] of triangles: that of the particles where it is left out; in the plane else 1. Warns of two that differ.
double read_thickness(const Value& force, ForcesRead& into);

bool is_viscous(const std::vector<Lame<double>>& viscous);

/// Their keys, and "elements".
SceneKeys elastic_keys();

}  // namespace jetlag
