// SPDX-License-Identifier: MIT
// "integrator": {"type": "implicit_subcycling", "coarse": [particles], "ratio": m}; "control" has the step of the fine.
#include "scenes/parts.hpp"

namespace jetlag {

ImplicitSubcycling::Options read_implicit_subcycling(const Value& integrator, double step, int particles) {
  integrator.only({"type", "coarse", "ratio"});
  constexpr int most = 1000000;
  ImplicitSubcycling::Options options;
  options.step = step;
  options.ratio = static_cast<int>(integrator.at("ratio").integer(1, most));
  const Value coarse = integrator.at("coarse");
  for (std::size_t i = 0; i < coarse.size(); ++i)
    options.coarse.push_back(static_cast<int>(coarse.at(i).integer(0, particles - 1)));
  return options;
}

}  // namespace jetlag
