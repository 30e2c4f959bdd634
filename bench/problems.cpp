// SPDX-License-Identifier: MIT
#include "problems.hpp"

#include <stdexcept>

#include "problems/nets.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"

namespace jetlag::bench {

Problem problem(const std::string& name) {
  if (name.starts_with("cloth")) return problems::cloth(std::stoi(name.substr(5)));
  if (name.starts_with("bodies")) return problems::bodies_at_rest(std::stoi(name.substr(6)));
  if (name == "kepler") return problems::inclined_pair();
  if (name == "planar_kepler") return problems::light_body();
  if (name == "solar") return problems::outer_solar_system();
  if (name == "sun_jupiter_saturn") return problems::outer_solar_system(3);
  if (name == "planet") return problems::planet(0.5);
  if (name == "pendulum") return problems::pendulum();
  if (name == "henon_heiles") return problems::henon_heiles({0.1, 0.2}, {0.3, -0.2});
  throw std::invalid_argument(
      "problem: '" + name +
      "' is not one of cloth<side>, bodies<number>, kepler, planar_kepler, solar, sun_jupiter_saturn, "
      "planet, pendulum, henon_heiles");
}

}  // namespace jetlag::bench
