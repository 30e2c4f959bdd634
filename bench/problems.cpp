// SPDX-License-Identifier: MIT
#include "problems.hpp"

#include <stdexcept>

#include "problems/nets.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"

namespace jetlag::bench {

Problem problem(const std::string& name) {
  if (name.starts_with("cloth")) return problems::cloth(std::stoi(name.substr(5)));
  if (name == "kepler") return problems::inclined_pair();
  if (name == "planar_kepler") return problems::light_body();
  if (name == "solar") return problems::outer_solar_system();
  if (name == "pendulum") return problems::pendulum();
  throw std::invalid_argument("problem: '" + name +
                              "' is not one of cloth<side>, kepler, planar_kepler, solar, pendulum");
}

}  // namespace jetlag::bench
