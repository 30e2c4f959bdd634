// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A cloth of triangles falls upon a sphere, hangs over to one side, and slides off: there is no friction. It may touch itself.
BuiltInScene drape() {
  return {"drape", "a cloth that falls over a sphere and slides off (110 vertices, 180 triangles)", R"({
  "name": "a cloth falls over a sphere and slides off",
  "dimension": 3,
  "particles": {
    "sheet": {"lengths": [0.9, 0.9], "cells": [9, 10], "pattern": "equilateral", "corner": [-0.6, -0.45, 0.34]},
    "density": 1000.0, "thickness": 1e-3
  },
  "obstacles": [{"sphere": {"radius": 0.3, "cells": 2}}],
  "forces": [
    {"type": "membrane", "young": 2e4, "poisson": 0.3, "thickness": 1e-3, "damping_time": 4e-3},
    {"type": "bending", "rigidity": 1e-4},
    {"type": "uniform_field", "acceleration": [0.0, 0.0, -9.8]},
    {"type": "drag", "rate": 2.0},
    {"type": "contact_barrier", "thickness": 0.03, "stiffness": 100.0}
  ],
  "integrator": {"type": "taylor", "degree": 6},
  "control": {"type": "last_two", "tolerance": 1e-5},
  "until": 0.9,
  "output": {"frames": 90}
})"};
}

}  // namespace jetlag
