// SPDX-License-Identifier: MIT
#pragma once
// Bodies of the solid laws, for tests.

#include <array>
#include <type_traits>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/scenes/mesh.hpp"

namespace jetlag::testing::solids {

/// f(std::type_identity<L>{}) for the elastic laws of tetrahedra.
template <class F>
void for_each_elastic_law(F f) {
  f(std::type_identity<Stvk>{});
  f(std::type_identity<NeoHookean>{});
  f(std::type_identity<StableNeoHookean>{});
  f(std::type_identity<PolynomialNeoHookean>{});
  f(std::type_identity<Corotated>{});
}

constexpr double young = 1e5, poisson = 0.3, density = 1000;  // [Pa], [1], [kg/m^3]

/// The forces on all particles [N]: of particles of 1 kg at rest, twice coefficient 2 of their positions.
inline Coordinates<double> forces_at(const System<double>& system, const Coordinates<double>& position) {
  Expansion<> motion(system);
  motion.start({0.0, position, Coordinates<double>::Zero(position.rows(), position.cols())});
  motion.grow();
  return 2 * Coordinates<double>(motion.position(2));
}

/// A body of particles of 1 kg.
template <class L>
System<double> body_of(const Mesh& mesh, const Lame<double>& lame) {
  System<double> system(3, std::vector<double>(mesh.position.rows(), 1.0));
  system.add_at_rest<L>(mesh.tetrahedra, mesh.position, {{lame.lambda, lame.mu}});
  return system;
}

}  // namespace jetlag::testing::solids
