// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A soft block under a ceiling with a core 10000 times stiffer, which takes short steps: a clock for each vertex.
BuiltInScene inclusion() {
  return {"inclusion", "a soft block with a stiff core, a clock for each vertex (1944 elements)", R"({
  "name": "a soft block with a stiff core swings from a ceiling",
  "dimension": 3,
  "particles": {
    "box": {"lengths": [1.0, 1.5, 1.0], "cells": [6, 9, 6]},
    "density": 1000.0, "fix_above": 0.0
  },
  "forces": [
    {"type": "stable_neo_hookean", "elements": {"outside": [[0.32, 0.32, 0.66], [0.68, 0.68, 1.0]]}, "young": 4e4, "poisson": 0.3},
    {"type": "stable_neo_hookean", "elements": {"inside": [[0.32, 0.32, 0.66], [0.68, 0.68, 1.0]]}, "young": 4e8, "poisson": 0.3},
    {"type": "uniform_field", "acceleration": [6.0, -9.8, 0.0]}
  ],
  "integrator": {"type": "taylor", "degree": 4},
  "control": {"type": "last_two", "tolerance": 1e-4, "courant": 0.5},
  "schedule": {"type": "block", "tolerance": 1e-4, "grading": 1},
  "until": 1.0,
  "output": {"frames": 100, "clocks": true}
})"};
}

}  // namespace jetlag
