// SPDX-License-Identifier: MIT
#pragma once
// Elastic bodies of tetrahedra, at rest.

#include <array>
#include <vector>

#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/forces/solids/stvk.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/scenes/mesh.hpp"

namespace jetlag::testing {

/// St. Venant-Kirchhoff's elasticity with Young's modulus [Pa], Poisson's ratio and density [kg/m^3]. stiffer: how many times
/// stiffer each tetrahedron is; empty: none.
inline System<double> elastic(const Mesh& mesh, double young, double poisson, double density,
                              const std::vector<double>& stiffer = {}) {
  System<double> system(3, lumped_masses(mesh.position, mesh.tetrahedra, density));
  const Lame<double> of = lame(young, poisson);
  std::vector<std::array<double, 2>> material;
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e) {
    const double times = stiffer.empty() ? 1.0 : stiffer[e];
    material.push_back({times * of.lambda, times * of.mu});
  }
  system.add_at_rest<Stvk>(mesh.tetrahedra, mesh.position, material);
  return system;
}

inline State<double> at_rest(const Mesh& mesh) {
  return {0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 3), {}, {}};
}

}  // namespace jetlag::testing
