// SPDX-License-Identifier: MIT
#pragma once
// The tangent of a whole system, added up element by element.

#include <Eigen/Core>
#include <cmath>

#include "model/element_tangents.hpp"

namespace jetlag::testing {

/// K = -dF/dx [N/m], or C = -dF/dv [N s/m], at a state, of all coordinates particle * dimension + component.
inline Eigen::MatrixXd whole_tangent(const Model<double>& model, const State<double>& state,
                                     Input::Kind by = Input::Kind::position) {
  const int d = model.dimension(), n = model.particles() * d;
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n, n);
  for (const auto& law : model.laws()) {
    ElementTangents tangents(law);
    tangents.take(state, by);
    for (const int e : law->all()) {
      const auto particles = law->particles_of(e);
      for (int row = 0; row < tangents.size(); ++row)
        for (int column = 0; column < tangents.size(); ++column)
          whole(particles[row / d] * d + row % d, particles[column / d] * d + column % d) +=
              tangents.of(e)(row, column);
    }
  }
  return whole;
}

/// M^-1/2 K M^-1/2, whose eigenvalues are the squares of the frequencies; zero in rows and columns of fixed particles.
inline Eigen::MatrixXd over_masses(Eigen::MatrixXd tangent, const Model<double>& model) {
  Eigen::VectorXd root(tangent.rows());
  for (Eigen::Index i = 0; i < root.size(); ++i)
    root(i) = std::sqrt(model.inverse_mass(static_cast<int>(i) / model.dimension()));
  return root.asDiagonal() * tangent * root.asDiagonal();
}

}  // namespace jetlag::testing
