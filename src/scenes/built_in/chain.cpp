// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// Three masses on a line, one spring 5000 times stiffer than the other.
BuiltInScene chain() {
  return {"chain", "three masses on a line, a stiff and a soft spring", R"({
  "name": "stiff chain",
  "dimension": 1,
  "particles": {
    "position": [[0.0], [1.0], [2.1]],
    "velocity": [[0.0], [0.0], [0.1]],
    "mass": [1.0, 1.0, 2.0],
    "fixed": [0]
  },
  "forces": [
    {"type": "spring", "pairs": [[0, 1], [1, 2]], "stiffness": [5000.0, 1.0], "rest_length": 1.0},
    {"type": "drag", "coefficient": 0.2}
  ],
  "integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 6, "probability": 0.5},
  "control": {"type": "fixed", "step": 0.005},
  "until": 10.0
})"};
}

}  // namespace jetlag
