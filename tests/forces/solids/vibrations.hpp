// SPDX-License-Identifier: MIT
#pragma once
// Small vibrations about a state: K u = omega^2 M u.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "integrators/implicit/linear_solver.hpp"
#include "jetlag/model/model.hpp"
#include "model/element_tangents.hpp"

namespace jetlag::testing::solids {

/// The tangent of the forces and the masses of what moves.
class Vibrations {
 public:
  Vibrations(const System<double>& system, const State<double>& at) : number_(system.particles(), -1) {
    dimension_ = system.dimension();
    for (int i = 0; i < system.particles(); ++i)
      if (!system.fixed()[i]) number_[i] = unknowns_++;
    unknowns_ *= dimension_;
    mass_.resize(unknowns_);
    for (int i = 0; i < system.particles(); ++i)
      for (int c = 0; c < dimension_ && number_[i] >= 0; ++c) mass_[row(i, c)] = system.mass()[i];
    const Model<double> model(system);
    for (const auto& law : model.laws()) {
      ElementTangents tangents(law);
      tangents.take(at);
      for (const int e : law->all()) add(law->particles_of(e), tangents.of(e));
    }
  }

  /// -1 of what is fixed.
  int row(int particle, int component) const {
    return number_[particle] < 0 ? -1 : number_[particle] * dimension_ + component;
  }

  /// The displacements under loads.
  Eigen::VectorXd under(const Eigen::VectorXd& load) const {
    return LinearSolver().solve(unknowns_, entries_, load);
  }

  int unknowns() const { return unknowns_; }

  /// u.K u / u.M u after iterating with (K - square M)^-1 M: the eigenvalue next to `square`, from above where that is below
  /// all of them. One iteration divides what it is off by (the distance of the others / its own)^2.
  double square_beside(double square, int iterations, Eigen::VectorXd u) const {
    LinearSolver::Entries shifted = entries_;
    for (int i = 0; i < unknowns_; ++i) shifted.emplace_back(i, i, -square * mass_[i]);
    LinearSolver solver;
    for (int n = 0; n < iterations; ++n) {
      u = solver.solve(unknowns_, shifted, mass_.cwiseProduct(u));
      u /= u.norm();
    }
    return quotient(u);
  }

  /// The same after iterating with M^-1 K: from below the largest.
  double square_below_largest(int iterations, Eigen::VectorXd u) const {
    for (int n = 0; n < iterations; ++n) {
      u = times(u).cwiseQuotient(mass_);
      u /= u.norm();
    }
    return quotient(u);
  }

  double quotient(const Eigen::VectorXd& u) const { return u.dot(times(u)) / u.dot(mass_.cwiseProduct(u)); }

  /// Without an order in it.
  Eigen::VectorXd mixture() const {
    Eigen::VectorXd u(unknowns_);
    for (int i = 0; i < unknowns_; ++i) u[i] = std::sin(1.0 + 7.0 * i * i);
    return u;
  }

 private:
  template <class Particles, class Tangent>
  void add(const Particles& particles, const Tangent& k) {
    const int rows = static_cast<int>(k.rows());
    for (int a = 0; a < rows; ++a)
      for (int b = 0; b < rows; ++b) {
        const int i = row(particles[a / dimension_], a % dimension_),
                  j = row(particles[b / dimension_], b % dimension_);
        if (i >= 0 && j >= 0) entries_.emplace_back(i, j, k(a, b));
      }
  }

  Eigen::VectorXd times(const Eigen::VectorXd& u) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns_);
    for (const auto& entry : entries_) sum[entry.row()] += entry.value() * u[entry.col()];
    return sum;
  }

  std::vector<int> number_;
  int dimension_ = 0, unknowns_ = 0;
  Eigen::VectorXd mass_;
  LinearSolver::Entries entries_;
};

}  // namespace jetlag::testing::solids
