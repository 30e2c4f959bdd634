// SPDX-License-Identifier: MIT
#pragma once
// What the picture of an ensemble shows.

#include "jetlag/runs/run_ensemble.hpp"

namespace jetlag {

/// EnsembleOptions::watch: components of the positions of particles. -1: any.
struct Watch {
  int particle = -1, component = -1;
};

/// Throws SceneError.
Watch read_watch(const Scene& scene, const std::string& text);

/// The number of the quantity that is watched: of those that may be the one that spreads most at the last frame.
std::size_t watched(const EnsembleResult& result, const Watch& watch);

}  // namespace jetlag
