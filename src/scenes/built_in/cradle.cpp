// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// Newton's cradle: five masses, each on a stiff spring as long as in equilibrium, 0.9 mm wider apart than their contact acts. One
/// of them is let go at 50 degrees. The energy stays as it is to rounding.
BuiltInScene cradle() {
  return {"cradle", "Newton's cradle of five masses that touch", R"({
  "name": "Newton's cradle",
  "dimension": 2,
  "particles": {
    "position": [[-0.766044443118978, -0.6427876096865393], [0.1009, -1.0], [0.2018, -1.0], [0.3027, -1.0], [0.4036, -1.0],
                 [0.0, 0.0], [0.1009, 0.0], [0.2018, 0.0], [0.3027, 0.0], [0.4036, 0.0]],
    "mass": 1.0,
    "fixed": [5, 6, 7, 8, 9]
  },
  "forces": [
    {"type": "spring", "pairs": [[0, 5], [1, 6], [2, 7], [3, 8], [4, 9]], "stiffness": 2e4, "rest_length": 0.9995095},
    {"type": "uniform_field", "acceleration": [0.0, -9.81]},
    {"type": "contact_barrier", "points": [0, 1, 2, 3, 4], "gap": 0.08, "thickness": 0.02, "stiffness": 1e4}
  ],
  "integrator": {"type": "taylor", "degree": 16},
  "control": {"type": "jorba_zou"},
  "until": 4.2,
  "output": {"frames": 210}
})"};
}

}  // namespace jetlag
