// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/rk4.hpp"

namespace jetlag {

const RungeKuttaTable& rk4() {
  static const RungeKuttaTable table{
      "rk4", 4, {{}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0}};
  return table;
}

const RungeKuttaTable& euler() {
  static const RungeKuttaTable table{"euler", 1, {{}}, {1}};
  return table;
}

}  // namespace jetlag
