// SPDX-License-Identifier: MIT
#pragma once
// Networks in another order of their particles.

#include <vector>

#include "support/problems.hpp"

namespace jetlag::testing {

/// The same scene with particle i called number[i]; the order of the elements stays.
inline Problem renumbered(const Problem& scene, const std::vector<int>& number) {
  const int particles = scene.system.particles();
  std::vector<double> mass(particles);
  for (int i = 0; i < particles; ++i) mass[number[i]] = scene.system.mass()[i];
  Problem result{System<double>(scene.system.dimension(), mass), scene.start};
  for (int i = 0; i < particles; ++i) {
    if (scene.system.fixed()[i]) result.system.fix(number[i]);
    result.start.position.row(number[i]) = scene.start.position.row(i);
    result.start.velocity.row(number[i]) = scene.start.velocity.row(i);
  }
  for (Elements<double> elements : scene.system.elements()) {
    for (int& particle : elements.particles) particle = number[particle];
    result.system.add(elements.law, elements.particles, elements.parameters);
  }
  return result;
}

}  // namespace jetlag::testing
