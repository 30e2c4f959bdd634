// SPDX-License-Identifier: MIT
#pragma once
// What an ensemble is asked for, checked.

#include "jetlag/runs/run_ensemble.hpp"

namespace jetlag {

/// The method of a scene that makes an ensemble. Throws SceneError.
const SeriesMethod& series_of(const Scene& scene, const EnsembleOptions& options);

/// Throws SceneError naming the option or the key as run_ensemble does.
void check(const Scene& scene, const EnsembleOptions& options);

}  // namespace jetlag
