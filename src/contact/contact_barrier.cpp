// SPDX-License-Identifier: MIT
#include "jetlag/contact/contact_barrier.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "contact/barrier_along.hpp"
#include "contact/barrier_laws.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

class ContactElements final : public ChangingElements {
 public:
  explicit ContactElements(const ContactBarrier& contact)
      : contact_(std::make_shared<const ContactBarrier>(contact)) {}
  std::unique_ptr<ElementsAlong> follow(const Model<double>& model, std::size_t first_law) const override {
    return std::make_unique<BarrierAlong>(contact_, model, first_law);
  }

 private:
  std::shared_ptr<const ContactBarrier> contact_;
};

void require(bool holds, const char* key, double value, const char* allowed) {
  if (!holds)
    throw std::invalid_argument("contact_barrier: " + std::string(key) + " is " + shown(value) +
                                ", and must be " + allowed);
}

/// Extent at rest: edges have a length, triangles an area.
void require_extent(const ContactBarrier& contact, int particles) {
  for (const int i : contact.surface.vertices())
    if (i < 0 || i >= particles)
      throw std::invalid_argument("contact_barrier: particle " + std::to_string(i) +
                                  " of the surface does not exist, there are " + std::to_string(particles));
  const auto at = [&](int i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head(contact.rest.cols()) = contact.rest.row(i);
    return x;
  };
  for (const auto& [a, b] : contact.surface.edges())
    if (!((at(a) - at(b)).norm() > 0))
      throw std::invalid_argument("contact_barrier: edge (" + std::to_string(a) + ", " + std::to_string(b) +
                                  ") has no length at rest");
  for (const auto& [a, b, c] : contact.surface.triangles()) {
    const Eigen::Vector3d e = at(b) - at(a), f = at(c) - at(a);
    if (!(detail::cross<double>(e, f).norm() > 1e-12 * e.norm() * f.norm()))
      throw std::invalid_argument("contact_barrier: triangle (" + std::to_string(a) + ", " +
                                  std::to_string(b) + ", " + std::to_string(c) + ") has no area at rest");
  }
}

}  // namespace

void add(System<double>& system, const ContactBarrier& contact) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  require(positive(contact.thickness), "thickness", contact.thickness, "> 0 and finite [m]");
  require(positive(contact.stiffness), "stiffness", contact.stiffness, "> 0 and finite [N/m]");
  require(contact.gap >= 0 && std::isfinite(contact.gap), "gap", contact.gap, ">= 0 and finite [m]");
  require(contact.power >= 1 && contact.power <= 7, "power", contact.power, "1 to 7");
  if (contact.rest.rows() != system.particles() || contact.rest.cols() != system.dimension() ||
      !contact.rest.allFinite())
    throw std::invalid_argument("contact_barrier: rest must be finite and have the shape (" +
                                std::to_string(system.particles()) + ", " +
                                std::to_string(system.dimension()) + ")");
  if (system.dimension() < 3 && !contact.surface.triangles().empty())
    throw std::invalid_argument("contact_barrier: triangles need three dimensions");
  if (system.dimension() < 2 && !contact.surface.edges().empty())
    throw std::invalid_argument("contact_barrier: edges need two dimensions or three");
  require_extent(contact, system.particles());
  system.add_changing(barrier_laws(system.dimension()), std::make_shared<ContactElements>(contact));
}

}  // namespace jetlag
