// SPDX-License-Identifier: MIT
#pragma once
// An order of the particles in which neighbours are near each other, so that elements run one after another find the
// particles of their neighbours in the cache.

#include <algorithm>
#include <numeric>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// The rank of each particle in the order of Cuthill and McKee (1969): breadth first over the graph of the pairs
/// that share an element, from a particle of least degree, neighbours by degree; ties by index. Shape (particles). The order in
/// which the particles are given is kept unless the other brings neighbours twice as near: rows are stored as given.
/// Empty for small systems, for which order does not matter, and for those where every particle meets every other.
template <class T>
std::vector<int> particle_order(const System<T>& system);

// ---- definitions -----------------------------------------------------------------------------------------

namespace detail {
/// rank of each vertex of a graph given by its edges, two vertices each.
std::vector<int> cuthill_mckee(int vertices, const std::vector<int>& edges);
}  // namespace detail

template <class T>
std::vector<int> particle_order(const System<T>& system) {
  constexpr std::size_t small = 1000, dense = 64;  // pairs; pairs for each particle
  std::vector<int> edges;
  for (const auto& elements : system.elements()) {
    const int p = elements.law.participants;
    for (std::size_t first = 0; first < elements.particles.size(); first += p)
      for (int i = 0; i < p; ++i)
        for (int j = i + 1; j < p; ++j)
          edges.insert(edges.end(), {elements.particles[first + i], elements.particles[first + j]});
  }
  if (edges.size() / 2 < small || edges.size() / 2 > dense * system.particles()) return {};
  return detail::cuthill_mckee(system.particles(), edges);
}

}  // namespace jetlag
