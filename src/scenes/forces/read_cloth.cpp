// SPDX-License-Identifier: MIT
// Forces of cloth: triangles that resist stretching, and edges between them that resist bending.
#include <algorithm>
#include <cmath>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/hinges.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/choices.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/forces/materials.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

void require_space(const Value& force, const ForcesRead& into) {
  require_dimension(force, into.particles.dimension, 3, 3,
                    into.particles.dimension == 2 ? ": in the plane take stvk" : "");
}

/// D = E t^3 / (12 (1 - nu^2)) [N m] of a plate.       Source: G. Kirchhoff's plate theory.
double plate_rigidity(const Lame<double>& of, double thickness) {
  const double young = of.mu * (3 * of.lambda + 2 * of.mu) / (of.lambda + of.mu),
               poisson = of.lambda / (2 * (of.lambda + of.mu));
  return young * std::pow(thickness, 3) / (12 * (1 - poisson * poisson));
}

void read_membrane(const Value& force, ForcesRead& into) {
  require_space(force, into);
  const Value listed = force.at("elements", "mesh");
  const Cells<3> cells = read_elements<3>(listed, into.particles, into.drawn);
  require_rest_shapes<3>(listed, cells, into.particles.rest);
  const double thickness = read_thickness(force, into);
  std::vector<std::string> of_locking;  // a sheet is free across: it does not lock
  const auto elastic = read_lame(force, cells.size(), of_locking);
  const auto viscous = read_viscosity(force, elastic);
  const bool of_one_material = std::ranges::all_of(
      elastic, [&](const auto& of) { return of.lambda == elastic[0].lambda && of.mu == elastic[0].mu; });
  into.rigidity.reset();
  if (!elastic.empty() && of_one_material) into.rigidity = plate_rigidity(elastic[0], thickness);
  const auto constants = [&](const std::vector<Lame<double>>& of) {
    std::vector<std::array<double, 3>> all;
    for (const auto& bulk : of) {
      const Lame<double> thin = plane_stress(bulk);
      all.push_back({thin.lambda, thin.mu, thickness});
    }
    return all;
  };
  checked(force, [&] {
    into.system.add_at_rest<Membrane>(cells, into.particles.rest, constants(elastic));
    if (is_viscous(viscous))
      into.system.add_at_rest<MembraneKelvinVoigt>(cells, into.particles.rest, constants(viscous));
    return true;
  });
}

/// A number, or "from_membrane": what a plate of its material and thickness has.
double read_rigidity(const Value& value, const ForcesRead& into) {
  if (!value.is_string()) return value.number(non_negative);
  value.one_of({"from_membrane"});
  if (!into.rigidity) value.refuse("a number [N m]: no membrane of one material stands before it");
  return *into.rigidity;
}

/// "rest_angle": "initial", that of the rest shape, or 0.
double read_angle_share(const Value& force) {
  const Value angle = force.at("rest_angle", "initial");
  if (angle.is_string()) {
    angle.one_of({"initial"});
    return 1;
  }
  if (angle.number() != 0) angle.refuse("\"initial\" or 0");
  return 0;
}

std::string edge_of(const Value& listed, const std::array<int, 4>& hinge) {
  return listed.path() + ", edge " + std::to_string(hinge[0]) + "-" + std::to_string(hinge[1]);
}

/// Where one triangle lies on the other, the angle is pi and -pi, and a flat one has none.
void require_no_full_fold(const Value& listed, const std::vector<std::array<int, 4>>& hinges,
                          const Coordinates<double>& position) {
  for (const auto& hinge : hinges) {
    const double angle = detail::Fold<double>(corners_of<3>(hinge, position)).angle();
    if (!(std::abs(angle) < 3.1415916))
      throw SceneError(
          edge_of(listed, hinge) +
          ": begins in full fold, or with a flat triangle; the model hinge must have an angle there");
  }
}

template <ForceLaw L, class... Material>
void add_hinges(const Value& listed, const std::vector<std::array<int, 4>>& hinges, ForcesRead& into,
                Material... material) {
  std::vector<std::array<double, L::parameters.size()>> parameters;
  for (const auto& hinge : hinges) try {
      parameters.push_back(
          L::template at_rest<double>(corners_of<3>(hinge, into.particles.rest), material...));
    } catch (const std::invalid_argument& why) {
      throw SceneError(edge_of(listed, hinge) + ": " + why.what());
    }
  checked(listed, [&] {
    into.system.add<L>(hinges, parameters);
    return true;
  });
}

void read_bending(const Value& force, ForcesRead& into) {
  require_space(force, into);
  const Value listed = force.at("elements", "mesh");
  Drawn not_drawn;
  const Cells<3> cells = read_elements<3>(listed, into.particles, not_drawn);
  require_rest_shapes<3>(listed, cells, into.particles.rest);
  const double rigidity = read_rigidity(force.at("rigidity", "from_membrane"), into);
  const auto hinges = checked(listed, [&] { return hinges_of(cells); });
  if (hinges.empty()) listed.refuse("such that there is an edge between two triangles");
  if (force.at("model", "quadratic").one_of({"quadratic", "hinge"}) == "hinge") {
    require_no_full_fold(listed, hinges, into.particles.state.position);
    add_hinges<Hinge>(listed, hinges, into, rigidity, read_angle_share(force));
  } else {
    if (const auto angle = force.find("rest_angle"))
      angle->refuse("left out for the model quadratic, which is flat");
    add_hinges<Bending>(listed, hinges, into, rigidity);
  }
}

}  // namespace

std::vector<ForceRecord> cloth_records() {
  return {
      {Membrane::name,
       "A sheet of triangles in space that resists stretching and shearing (St. Venant and Kirchhoff's law "
       "in plane "
       "stress)",
       joined({elastic_keys(), {{"thickness", "[m], > 0", "required, or that of the particles"}}}),
       read_membrane},
      {Bending::name,
       "Edges between triangles of a sheet that resist bending. With right-angled triangles it is up to "
       "three times "
       "too stiff, by the direction: take a sheet of the pattern `equilateral`",
       {elastic_keys()[0],
        {"rigidity",
         "[N m], >= 0, of a plate: E t^3 / (12 (1 - nu^2)); `from_membrane`: that of the membrane before it",
         "from_membrane"},
        {"model",
         "`quadratic`: linear forces, for sheets that are flat at rest and hardly stretch; `hinge`: of the "
         "angles at the "
         "edges, for any, at three to five times the cost",
         "quadratic"},
        {"rest_angle", "of the model hinge: `initial`, that at rest, or 0: it wants to be flat",
         "none for quadratic; initial for hinge"}},
       read_bending}};
}

}  // namespace jetlag
