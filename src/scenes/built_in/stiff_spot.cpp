// SPDX-License-Identifier: MIT
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

/// Fourteen masses between walls, one spring 10000 times stiffer than the others: only its neighbourhood takes short steps.
BuiltInScene stiff_spot() {
  return {"stiff_spot", "fourteen masses with one stiff spring, a clock for each", R"({
  "name": "one stiff spring, a clock for each mass",
  "dimension": 1,
  "particles": {
    "position": [[0.0], [1.0], [2.0], [3.0], [4.0], [5.0], [6.0], [7.0], [8.0], [9.0], [10.0], [11.0], [12.0], [13.0], [14.0], [15.0]],
    "velocity": [[0], [0.081], [0.149], [0.19], [0.199], [0.173], [0.118], [0.042], [-0.042], [-0.118], [-0.173], [-0.199], [-0.19], [-0.149], [-0.081], [0]],
    "mass": 1.0,
    "fixed": [0, 15]
  },
  "forces": [
    {
      "type": "spring",
      "pairs": [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7], [7, 8], [8, 9], [9, 10], [10, 11], [11, 12], [12, 13], [13, 14], [14, 15]],
      "stiffness": [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1e4, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
      "rest_length": 1.0
    }
  ],
  "integrator": {"type": "taylor", "degree": 8},
  "control": {"type": "last_two", "tolerance": 1e-9, "courant": 0.9},
  "schedule": {"type": "block"},
  "until": 10.0,
  "output": {"clocks": true}
})"};
}

}  // namespace jetlag
