// SPDX-License-Identifier: MIT
// "integrator": {"type": "implicit_subcycling", "coarse": [particles], "ratio": m}; "control" has the step of the fine.
#include "scenes/parts.hpp"

namespace jetlag {

ImplicitSubcycling::Options read_implicit_subcycling(const Value& integrator, double step,
                                                     const System<double>& system) {
  integrator.only({"type", "coarse", "ratio"});
  constexpr int most = 1000000;
  ImplicitSubcycling::Options options;
  options.step = step;
  options.ratio = static_cast<int>(integrator.at("ratio").integer(1, most));
  const std::vector<bool> coarse = read_partition(integrator.at("coarse"), system);
  for (int i = 0; i < system.particles(); ++i)
    if (coarse[i]) options.coarse.push_back(i);
  return options;
}

}  // namespace jetlag
