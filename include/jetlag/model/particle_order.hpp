// SPDX-License-Identifier: MIT
#pragma once
// An order of the particles in which neighbours are near each other, so that elements run one after another find the
// particles of their neighbours in the cache.

#include <vector>

namespace jetlag {

/// The rank of each particle in the order of Cuthill and McKee (1969): breadth first over the graph of the pairs that
/// share an element (two particles each), from a particle of least degree, neighbours by degree; ties by index. Shape
/// (particles). The order in which the particles are given is kept unless the other brings neighbours twice as near: rows
/// are stored as given. Empty for small systems, for which order does not matter, and for those where every particle meets
/// every other.
std::vector<int> particle_order(int particles, const std::vector<int>& pairs);

}  // namespace jetlag
