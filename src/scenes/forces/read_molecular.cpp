// SPDX-License-Identifier: MIT
// Forces between the bonds of molecules: angles, and torsion about a bond.
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "jetlag/forces/forces.hpp"
#include "scenes/choices.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

/// "elements": lists of particles along the bonds, which are drawn. No bond may have the length 0.
template <std::size_t P>
Cells<P> read_bonded(const Value& list, ForcesRead& into) {
  Cells<P> all;
  if (list.size() == 0) list.refuse("such that there are elements");
  for (std::size_t e = 0; e < list.size(); ++e) {
    all.push_back(read_members<P>(list.at(e), into.particles.rest.rows()));
    for (std::size_t i = 1; i < P; ++i) {
      const int a = all[e][i - 1], b = all[e][i];
      if (into.particles.state.position.row(a) == into.particles.state.position.row(b) ||
          into.particles.rest.row(a) == into.particles.rest.row(b))
        list.at(e).refuse("of particles that lie in different places, neighbours along the bonds");
      into.drawn.lines.push_back({a, b});
    }
  }
  return all;
}

double cosine_at(const std::array<int, 3>& element, const Coordinates<double>& rest) {
  const Eigen::RowVectorXd a = rest.row(element[0]) - rest.row(element[1]),
                           b = rest.row(element[2]) - rest.row(element[1]);
  return a.dot(b) / (a.norm() * b.norm());
}

void read_angle(const Value& force, ForcesRead& into) {
  require_dimension(force, into.particles.dimension, 2, 3);
  const Cells<3> elements = read_bonded<3>(force.at("elements"), into);
  const auto stiffness = force.at("stiffness").numbers(elements.size(), non_negative, "element");
  const Value angle = force.at("angle", "initial");
  std::vector<double> cosine;
  if (angle.is_string()) {
    angle.one_of({"initial"});
    for (const auto& element : elements) cosine.push_back(cosine_at(element, into.particles.rest));
  } else {
    const Range half_turn{0, std::numbers::pi, true, true, "a number from 0 to pi, or \"initial\""};
    for (const double phi : angle.numbers(elements.size(), half_turn, "element"))
      cosine.push_back(std::cos(phi));
  }
  std::vector<std::array<double, 2>> parameters;
  for (std::size_t e = 0; e < elements.size(); ++e) parameters.push_back({stiffness[e], cosine[e]});
  checked(force, [&] {
    into.system.add<Angle>(elements, parameters);
    return true;
  });
}

void read_dihedral(const Value& force, ForcesRead& into) {
  require_dimension(force, into.particles.dimension, 3, 3);
  const Value listed = force.at("elements");
  const Cells<4> elements = read_bonded<4>(listed, into);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto [a, b, c, d] = elements[e];
    const detail::Fold<double> fold(corners_of<3>(std::array{b, c, a, d}, into.particles.state.position));
    if (!(fold.n_2.norm() > 0 && fold.n_3.norm() > 0))
      listed.at(e).refuse("of bonds that are not in line where they begin");
  }
  const auto stiffness = force.at("stiffness").numbers(elements.size(), any_number, "element"),
             phase = force.at("phase", 0.0).numbers(elements.size(), any_number, "element");
  std::vector<std::array<double, 2>> parameters;
  for (std::size_t e = 0; e < elements.size(); ++e) parameters.push_back({stiffness[e], phase[e]});
  const auto multiplicity = force.at("multiplicity", 1).integer(1, 3);
  checked(force, [&] {
    if (multiplicity == 1)
      into.system.add<Dihedral<1>>(elements, parameters);
    else if (multiplicity == 2)
      into.system.add<Dihedral<2>>(elements, parameters);
    else
      into.system.add<Dihedral<3>>(elements, parameters);
    return true;
  });
}

}  // namespace

std::vector<ForceRecord> molecular_records() {
  const SceneKey stiffness{"stiffness", "k [J], >= 0: one for all or one for each", "required"};
  return {
      {Angle::name,
       "The angle between two bonds, in the plane or in space: k/2 (cos phi - cos phi_0)^2",
       {{"elements", "a list of three particles each, the angle at the second", "required"},
        stiffness,
        {"angle", "phi_0 [rad], 0 to pi: one for all or one for each; `initial`: that at rest", "initial"}},
       read_angle},
      {"dihedral",
       "Torsion about a bond in space: k (1 + cos(n phi - phase))",
       {{"elements", "a list of four particles each, along the bonds", "required"},
        {"stiffness", "k [J]: one for all or one for each", "required"},
        {"multiplicity", "n, 1 to 3", "1"},
        {"phase", "[rad]: one for all or one for each", "0"}},
       read_dihedral}};
}

}  // namespace jetlag
