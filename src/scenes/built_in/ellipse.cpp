// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// The paper's figure 1: a truncated ellipse of springs in the plane, each particle with a random degree of its own, so
/// that the points spread about their expectation.
BuiltInScene ellipse() {
  return {"ellipse", "the paper's figure 1: a truncated ellipse of springs in the plane", R"({
  "name": "ellipse",
  "dimension": 2,
  "particles": {
    "ellipse": {"radii": [2.0, 1.2], "cells": [20, 12], "cut": [0.95, 0.85]},
    "mass": 1.0,
    "fix_above": 0.0,
    "velocity": [1.5, 0.0]
  },
  "forces": [
    {"type": "spring", "pairs": "edges", "stiffness": 5000.0, "rest_length": "initial"},
    {"type": "uniform_field", "acceleration": [0.0, -9.8]},
    {"type": "drag", "coefficient": 0.2}
  ],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.5, "shared_draw": false},
  "control": {"type": "fixed", "step": 0.0025},
  "until": 4.0,
  "seed": 1
})"};
}

}  // namespace jetlag
