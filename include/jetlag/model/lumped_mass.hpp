// SPDX-License-Identifier: MIT
#pragma once
// Masses of the vertices of a mesh.

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/forces/solids/simplex.hpp"
#include "jetlag/model/system.hpp"

namespace jetlag {

namespace detail {

/// See lumped_masses.
template <int D, std::size_t P, class T>
std::vector<T> lumped_masses_in(const Coordinates<T>& rest, const std::vector<std::array<int, P>>& elements,
                                const T& density, const T& thickness) {
  using std::isfinite;
  const auto refuse = [](const std::string& why) { throw std::invalid_argument("lumped_masses: " + why); };
  if (rest.cols() != D)
    refuse(std::string("positions must have ") + (P == 3 ? "2 or 3" : "3") + " components");
  if (!(density > T(0))) refuse("density must be > 0, got " + text_of(density) + " kg/m^3");
  std::vector<T> mass(rest.rows(), T(0));
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::array<Vector<T, D>, P> x;
    for (std::size_t i = 0; i < P; ++i) {
      if (elements[e][i] < 0 || elements[e][i] >= rest.rows())
        refuse("element " + std::to_string(e) + ": there is no vertex " + std::to_string(elements[e][i]));
      x[i] = rest.row(elements[e][i]);
    }
    try {
      const T volume = volume_of_material(rest_shape<T, D, P - 1>(x), thickness);
      if (!isfinite(T(density * volume)))
        throw std::invalid_argument("its positions, the thickness and its mass must be finite");
      for (const int i : elements[e]) mass[i] += density * volume / T(P);
    } catch (const std::invalid_argument& why) {
      refuse("element " + std::to_string(e) + ": " + why.what());
    }
  }
  return mass;
}

}  // namespace detail

/// m_i = sum over the elements at i of density x volume / (D + 1) [kg]: each element hands its mass to its vertices in equal
/// parts. Tetrahedra in space (P = 4), triangles of a thickness [m] in the plane or in space (P = 3).
/// rest: positions at rest [m], shape (vertices, D), D = 3, or of triangles 2 or 3; density [kg/m^3], > 0. A vertex of no
/// element has mass 0.
/// Throws std::invalid_argument for what is out of range, and for an element that is flat or of negative volume.
template <std::size_t P, class T>
  requires(P == 3 || P == 4)
std::vector<T> lumped_masses(const Coordinates<T>& rest, const std::vector<std::array<int, P>>& elements,
                             const T& density, const T& thickness = T(1)) {
  if constexpr (P == 3)
    if (rest.cols() == 3) return detail::lumped_masses_in<3>(rest, elements, density, thickness);
  return detail::lumped_masses_in<P - 1>(rest, elements, density, thickness);
}

}  // namespace jetlag
