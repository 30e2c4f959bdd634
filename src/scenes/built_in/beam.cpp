// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A rubber beam of neo-Hookean tetrahedra, clamped at one end: it falls under its weight and swings. Its viscosity damps a
/// vibration of frequency w by the ratio w/1000. Degree 6 keeps 1e-9 m at these steps.
BuiltInScene beam() {
  return {"beam", "a rubber beam of tetrahedra that falls and swings at its clamp (1152 elements)", R"({
  "name": "a beam of rubber falls and swings at its clamp",
  "dimension": 3,
  "particles": {
    "box": {"lengths": [1.2, 0.4, 0.4], "cells": [12, 4, 4]},
    "density": 1000.0,
    "fix_axis": "x", "fix_below": 0.0
  },
  "forces": [
    {"type": "neo_hookean", "young": 4e5, "poisson": 0.3, "damping_time": 0.002},
    {"type": "uniform_field", "acceleration": [0.0, -9.8, 0.0]}
  ],
  "integrator": {"type": "taylor", "degree": 6},
  "control": {"type": "fixed", "step": 0.002},
  "until": 2.0,
  "output": {"frames": 100}
})"};
}

}  // namespace jetlag
