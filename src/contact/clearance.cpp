// SPDX-License-Identifier: MIT
#include "jetlag/contact/clearance.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/crossings.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/contact/candidates.hpp"

namespace jetlag {

namespace {

/// Features that may be no farther apart than that [m], and some that are; ascending.
std::vector<Stencil> near_stencils(const System<double>& system, const ContactBarrier& contact, double reach,
                                   bool with_itself, const Coordinates<double>& position) {
  System<double> without_forces(system.dimension(), system.mass());
  for (int i = 0; i < system.particles(); ++i)
    if (system.fixed()[i]) without_forces.fix(i);
  Candidates candidates(contact.surface, without_forces, reach, with_itself);
  AlignedVector<double> at_rest(position.data(), position.data() + position.size());
  at_rest.resize(2 * at_rest.size(), 0.0);
  const PositionSeries series{0.0,
                              1.0,
                              at_rest.data(),
                              1,
                              static_cast<std::size_t>(position.size()),
                              static_cast<std::size_t>(position.cols())};
  candidates.cover(SeriesAhead(series, system.dimension(), 0.0), 0.0);
  return candidates.list();
}

double distance_of(const Stencil& stencil, const Coordinates<double>& position) {
  std::array<Eigen::Vector3d, 4> x;
  x.fill(Eigen::Vector3d::Zero());
  for (int i = 0; i < vertices_of(stencil.kind); ++i)
    x[i].head(position.cols()) = position.row(stencil.vertices[i]);
  return closest(stencil.kind, std::span(x).first(vertices_of(stencil.kind))).distance;
}

/// The nearest of them, the first where several are; nothing if there are none.
std::optional<Clearance> nearest_of(const std::vector<Stencil>& stencils,
                                    const Coordinates<double>& position) {
  std::optional<Clearance> nearest;
  for (const Stencil& stencil : stencils) {
    const double distance = distance_of(stencil, position);
    if (!nearest || distance < nearest->distance) nearest = {stencil, distance};
  }
  return nearest;
}

}  // namespace

void require_apart(const System<double>& system, const ContactBarrier& contact,
                   const Coordinates<double>& position) {
  const std::vector<int> none;
  require_no_crossing(contact.surface, system.fixed(),
                      contact.with_itself ? none : bodies_of(contact.surface, system.particles()), position);
  const auto nearest = nearest_of(
      near_stencils(system, contact, contact.gap + contact.thickness, contact.with_itself, position),
      position);
  if (nearest && !(nearest->distance > contact.gap))
    throw std::invalid_argument(names_of(nearest->stencil) + " are " + shown(nearest->distance) +
                                " m apart, no more than the gap " + shown(contact.gap) +
                                " m: move them apart or lower the gap");
}

std::optional<Clearance> nearest_of_one_body(const System<double>& system, const ContactBarrier& contact) {
  if (!contact.with_itself) return {};
  const double reach = contact.gap + contact.thickness;
  const auto bodies = bodies_of(contact.surface, system.particles());
  auto stencils = near_stencils(system, contact, reach, true, contact.rest);
  std::erase_if(stencils, [&](const Stencil& stencil) {
    return bodies[stencil.particles().front()] != bodies[stencil.particles().back()];
  });
  const auto nearest = nearest_of(stencils, contact.rest);
  return nearest && nearest->distance < reach ? nearest : std::nullopt;
}

}  // namespace jetlag
