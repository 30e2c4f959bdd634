// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// An elastic bar that flies and tumbles freely: momentum, angular momentum and energy stay as they are.
BuiltInScene spinning_bar() {
  return {"spinning_bar", "an elastic bar of tetrahedra that flies and tumbles freely (144 elements)", R"({
  "name": "an elastic bar tumbles freely",
  "dimension": 3,
  "particles": {
    "box": {"lengths": [0.2, 0.6, 0.2], "cells": [2, 6, 2]},
    "density": 1000.0,
    "velocity": {"spin": [3.0, 1.0, 9.0], "drift": [0.1, 0.2, 0.3]}
  },
  "forces": [{"type": "neo_hookean", "young": 1e5, "poisson": 0.3}],
  "integrator": {"type": "taylor", "degree": 12},
  "control": {"type": "jorba_zou", "courant": 0.9},
  "until": 2.0,
  "output": {"frames": 100}
})"};
}

}  // namespace jetlag
