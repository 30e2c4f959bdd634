// SPDX-License-Identifier: MIT
#include "problems/problem.hpp"

#include <algorithm>
#include <cmath>

namespace jetlag::problems {

State<double> at_origin(const System<double>& system) {
  return {0.0, Coordinates<double>::Zero(system.particles(), system.dimension()),
          Coordinates<double>::Zero(system.particles(), system.dimension())};
}

std::size_t element_count(const System<double>& system) {
  std::size_t count = 0;
  for (const auto& elements : system.elements()) count += elements.count();
  return count;
}

bool conserves_energy(const System<double>& system) {
  return std::ranges::all_of(system.elements(), [](const auto& elements) {
    return elements.count() == 0 || elements.law.energy.has_value();
  });
}

double distance(const System<double>& system, const Coordinates<double>& x, const Coordinates<double>& y) {
  double sum = 0;
  int moving = 0;
  for (int i = 0; i < system.particles(); ++i)
    if (!system.fixed()[i]) {
      sum += (x.row(i) - y.row(i)).squaredNorm();
      ++moving;
    }
  return std::sqrt(sum / std::max(1, moving));
}

}  // namespace jetlag::problems
