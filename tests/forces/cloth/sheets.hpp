// SPDX-License-Identifier: MIT
#pragma once
// Sheets of cloth, for tests.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/model/hinges.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/scenes/mesh.hpp"

namespace jetlag::testing::cloth {

constexpr double young = 1e5, poisson = 0.3, thickness = 1e-3, density = 200;  // [Pa], [1], [m], [kg/m^3]

/// Hinges of rigidity 1 N m of a mesh alone, of a law of bending, of particles of 1 kg.
template <class L>
System<double> bending_of(const Mesh& mesh) {
  System<double> system(3, std::vector<double>(mesh.position.rows(), 1.0));
  std::array<double, L::material.size()> material{1.0};
  system.add_at_rest<L>(hinges_of(mesh.triangles), mesh.position, {material});
  return system;
}

/// Membranes, their viscosity of a damping time [s], and one law of bending. The rigidity is that of another thickness, that
/// bending counts.
template <class L>
System<double> cloth_of(const Mesh& mesh, double damping_time) {
  System<double> system(3, lumped_masses(mesh.position, mesh.triangles, density, thickness));
  const auto [lambda, mu] = plane_stress(lame(young, poisson));
  system.add_at_rest<Membrane>(mesh.triangles, mesh.position, {{lambda, mu, thickness}});
  if (damping_time > 0)
    system.add_at_rest<MembraneKelvinVoigt>(mesh.triangles, mesh.position,
                                            {{damping_time * lambda, damping_time * mu, thickness}});
  std::array<double, L::material.size()> material{1e-3};
  system.add_at_rest<L>(hinges_of(mesh.triangles), mesh.position, {material});
  return system;
}

/// The forces on all particles [N]: twice coefficient 2 of positions at rest, times the masses.
inline Coordinates<double> forces_at(const System<double>& system, const Coordinates<double>& position) {
  Expansion<> motion(system);
  motion.start({0.0, position, Coordinates<double>::Zero(position.rows(), position.cols())});
  motion.grow();
  Coordinates<double> force = 2 * Coordinates<double>(motion.position(2));
  for (int i = 0; i < force.rows(); ++i) force.row(i) *= system.mass()[i];
  return force;
}

}  // namespace jetlag::testing::cloth
