// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A sheet of triangles at a pole, in two fields that swing. It may pass through itself: nothing keeps it from it.
BuiltInScene flag() {
  return {"flag", "a flag of triangles in gusts (1380 membrane elements, 2017 hinges)", R"({
  "name": "a flag in gusts",
  "dimension": 3,
  "particles": {
    "sheet": {"lengths": [1.5, 1.0], "cells": [30, 23], "pattern": "equilateral"},
    "density": 1000.0, "thickness": 5e-4, "fix_axis": "x", "fix_below": 0.03
  },
  "forces": [
    {"type": "membrane", "young": 4e5, "poisson": 0.3, "thickness": 5e-4, "damping_time": 5e-4},
    {"type": "bending", "rigidity": 3e-4},
    {"type": "uniform_field", "acceleration": [5.0, -5.1, 0.0]},
    {"type": "oscillating_field", "acceleration": [0.0, 0.0, 7.0], "frequency": 0.8},
    {"type": "oscillating_field", "acceleration": [3.0, 2.0, 3.0], "frequency": 1.7},
    {"type": "drag", "rate": 0.8}
  ],
  "integrator": {"type": "taylor", "degree": 6},
  "control": {"type": "last_two", "tolerance": 1e-6},
  "until": 3.0,
  "output": {"frames": 120}
})"};
}

}  // namespace jetlag
