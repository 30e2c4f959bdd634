// SPDX-License-Identifier: MIT
#include "scenes/forces/materials.hpp"

#include <algorithm>

#include "jetlag/base/text.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

std::vector<Lame<double>> read_lame(const Value& force, std::size_t count,
                                    std::vector<std::string>& warnings) {
  if (const auto constants = force.find("lame")) {
    for (const char* other : {"young", "poisson"})
      if (force.has(other)) constants->refuse(std::string("left out beside ") + other);
    const auto both = constants->vector(2);
    checked(*constants, [&] {
      detail::require_elastic(both[0], both[1]);
      return true;
    });
    return std::vector<Lame<double>>(count, {both[0], both[1]});
  }
  const auto young = force.at("young").numbers(count, positive, "element");
  const Value ratio = force.at("poisson");
  const auto poisson =
      ratio.numbers(count,
                    {-1, 0.5, false, false,
                     "a number > -1 and < 0.5: 0.5 is incompressible, where the stiffness is infinite; 0.499 "
                     "is the most that is worth trying"},
                    "element");
  if (const double most = count > 0 ? std::ranges::max(poisson) : 0.0; most > 0.45)
    warnings.push_back(
        ratio.path() + ": " + shown(most) +
        " is nearly incompressible, where linear elements lock: the body is too stiff (a "
        "cantilever of 20 x 4 x 4 cells at 0.499 vibrates 2.8 times too fast); finer meshes help "
        "little");
  std::vector<Lame<double>> constants;
  for (std::size_t e = 0; e < count; ++e) constants.push_back(lame(young[e], poisson[e]));
  return constants;
}

std::vector<Lame<double>> read_viscosity(const Value& force, const std::vector<Lame<double>>& elastic) {
  std::vector<Lame<double>> viscous;
  if (const auto viscosity = force.find("viscosity")) {
    if (force.has("damping_time")) viscosity->refuse("left out beside damping_time");
    viscosity->only({"bulk_like", "shear"});
    const Value bulk = viscosity->at("bulk_like", 0.0);
    const double lambda = bulk.number(), mu = viscosity->at("shear").number(non_negative);
    if (!(3 * lambda + 2 * mu >= 0)) bulk.refuse("a number >= -2/3 of shear");
    viscous.assign(elastic.size(), {lambda, mu});
  } else {
    const auto time = force.at("damping_time", 0.0).numbers(elastic.size(), non_negative, "element");
    for (std::size_t e = 0; e < elastic.size(); ++e)
      viscous.push_back({time[e] * elastic[e].lambda, time[e] * elastic[e].mu});
  }
  return viscous;
}

double read_thickness(const Value& force, ForcesRead& into) {
  const auto& of_mass = into.particles.thickness;
  const bool is_required = into.particles.dimension == 3 && !of_mass;
  const Value value = is_required ? force.at("thickness") : force.at("thickness", of_mass.value_or(1.0));
  const double thickness = value.number(positive);
  if (of_mass && thickness != *of_mass)
    into.warnings.push_back(value.path() + ": " + shown(thickness) + " m, but the mass is that of " +
                            shown(*of_mass) + " m (particles.thickness)");
  return thickness;
}

bool is_viscous(const std::vector<Lame<double>>& viscous) {
  return std::ranges::any_of(viscous, [](const auto& v) { return v.lambda != 0 || v.mu != 0; });
}

SceneKeys elastic_keys() {
  return {
      {"elements",
       "`mesh`: all tetrahedra, in the plane triangles, of the particles; `{\"inside\": [low, high]}` or "
       "`{\"outside\": [low, high]}`: those whose middle at rest is in a box of two corners, or not; or a "
       "list",
       "mesh"},
      {"young", "Young's modulus [Pa], > 0: one for all or one for each element", "required, or `lame`"},
      {"poisson",
       "Poisson's ratio, > -1 and < 0.5: one for all or one for each. Above 0.45 linear elements lock",
       "required, or `lame`"},
      {"lame", "both constants of Lame [Pa], lambda and mu, in place of young and poisson", "none"},
      {"damping_time",
       "[s], >= 0, of Kelvin and Voigt's viscosity: this times the elastic constants; a vibration of "
       "frequency w has "
       "the damping ratio w times half of it. `control.courant` counts it. One for all or one for each",
       "0"},
      {"viscosity", "`{\"bulk_like\": lambda, \"shear\": mu}` [Pa s], in place of damping_time", "none"}};
}

}  // namespace jetlag
