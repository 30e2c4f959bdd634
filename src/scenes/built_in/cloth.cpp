// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// A square of cloth in space (structural, shear and bend springs), held at two corners.
BuiltInScene cloth() {
  return {"cloth", "a 20 x 20 cloth held at two corners", R"({
  "name": "cloth",
  "dimension": 3,
  "particles": {"grid": [20, 20], "spacing": 0.1, "springs": "cloth", "mass": 0.02, "fixed": [19, 399]},
  "forces": [
    {"type": "spring", "pairs": "edges", "stiffness": 100.0, "rest_length": "initial"},
    {"type": "uniform_field", "acceleration": [0.0, -2.0, -9.8]},
    {"type": "drag", "coefficient": 0.01}
  ],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4, "probability": 0.5},
  "control": {"type": "fixed", "step": 0.005, "courant": 0.9},
  "until": 3.0
})"};
}

}  // namespace jetlag
