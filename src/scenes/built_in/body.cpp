// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A soft body of springs on the edges of a tetrahedral mesh, held at nine vertices of its top and pushed aside: it falls
/// into its springs, swings and settles. The mesh is a truncated ellipsoid; any Medit file can take its place:
///     --set particles='{"mesh": "bunny.mesh", "fix_below": 3.0}'
BuiltInScene body() {
  return {"body", "a soft tetrahedral body that falls, swings and settles (729 vertices, 4184 springs)", R"({
  "name": "a soft body is pushed, swings and settles",
  "dimension": 3,
  "particles": {
    "ellipsoid": {"radii": [0.8, 1.2, 0.8], "cells": [8, 8], "cut": [0.9, 0.95]},
    "mass": 1.0,
    "fixed": [318, 319, 320, 399, 400, 401, 480, 481, 482],
    "velocity": [5.0, 0.0, 0.0]
  },
  "forces": [
    {"type": "spring", "pairs": "edges", "stiffness": 8000.0, "rest_length": "initial"},
    {"type": "uniform_field", "acceleration": [0.0, -9.8, 0.0]},
    {"type": "drag", "coefficient": 0.5}
  ],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4, "probability": 0.5},
  "control": {"type": "fixed", "step": 0.0025},
  "until": 7.0,
  "seed": 1,
  "output": {"frames": 140}
})"};
}

}  // namespace jetlag
