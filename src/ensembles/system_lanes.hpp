// SPDX-License-Identifier: MIT
#pragma once
// The series of one system for a block of trajectories, one in each lane: what the ensembles have in common.

#include <vector>

#include "ensembles/ensemble_lanes.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

struct SystemLanes {
  explicit SystemLanes(const Model<double>& model);

  int particles, dimension, components;
  std::size_t elements = 0;
  std::vector<bool> fixed;           // shape (particles)
  std::vector<double> inverse_mass;  // of each component; 0: fixed
  Program program;
  std::vector<Place> series;  // of each component of the positions: every order is kept
  bool reads_velocity = false;

  /// The series of the positions up to `order`, from their orders up to `known`, 1 at first.   time: one for each lane [s].
  /// unit [s]: a power of two; coefficient k comes times unit^k, with the same digits, as in Expansion.
  void grow(Blocks<double>& blocks, const EnsembleLanes& lanes, const double* time, int order,
            double unit = 1, int known = 1) const;
};

}  // namespace jetlag
