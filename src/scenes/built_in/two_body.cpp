// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// Kepler's problem, eccentricity 1/2, period 2 pi: 100 revolutions about a fixed mass, to rounding.
BuiltInScene two_body() {
  return {"two_body", "Kepler's problem, eccentricity 0.5, 100 revolutions", R"({
  "name": "two body",
  "dimension": 2,
  "particles": {
    "position": [[0.0, 0.0], [0.5, 0.0]],
    "velocity": [[0.0, 0.0], [0.0, 1.7320508075688772]],
    "mass": 1.0,
    "fixed": [0]
  },
  "forces": [{"type": "gravity", "constant": 1.0}],
  "integrator": {"type": "taylor", "degree": 20},
  "control": {"type": "jorba_zou"},
  "until": 628.3185307179587,
  "output": {"frames": 2000}
})"};
}

}  // namespace jetlag
