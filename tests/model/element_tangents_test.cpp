// SPDX-License-Identifier: MIT
// The tangents of elements, against closed forms, against the Jacobian of the whole system, and known frequencies of bodies.
#include "model/element_tangents.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "model/element_jacobian.hpp"
#include "model/whole_tangent.hpp"
#include "support/eigenvalues.hpp"
#include "support/laws/elastic_box.hpp"
#include "support/laws/laws_of_many.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"

namespace jetlag::testing::element_tangents_test {
namespace {

TEST(ElementTangents, OfASpringIsKnown) {
  // With n = d / |d|:  B = k (1 - L/|d|) (1 - n n^T) + k n n^T,  K = (B, -B; -B, B).
  const double k = 3.0, length = 0.7;
  System<double> system(3, {1.0, 2.0});
  system.add<Spring>({{0, 1}}, {{k, length}});
  State<double> state{0.0, Coordinates<double>(2, 3), Coordinates<double>::Zero(2, 3)};
  state.position << 0.1, -0.2, 0.3, 0.9, 0.5, -0.4;
  ElementTangents tangents(Model<double>(system).laws()[0]);
  tangents.take(state);
  const Eigen::Vector3d d = (state.position.row(1) - state.position.row(0)).transpose();
  const Eigen::Matrix3d along = d * d.transpose() / d.squaredNorm(),
                        b = k * along + k * (1 - length / d.norm()) * (Eigen::Matrix3d::Identity() - along);
  Eigen::MatrixXd truth(6, 6);
  truth << b, -b, -b, b;
  EXPECT_LE((tangents.of(0) - truth).cwiseAbs().maxCoeff(),
            16 * 3.0 * 0x1p-53);  // some ten roundings of up to k
}

/// F_i = -c (v_i - v_2), of three.
struct Viscous {
  static constexpr const char* name = "viscous";
  static constexpr int participants = 3;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static std::array<Vector<T, D>, 2> forces(const Participants<T, D, 3>& p, const T& c) {
    return {Vector<T, D>(T(-c) * (p.velocity[0] - p.velocity[2])),
            Vector<T, D>(T(-c) * (p.velocity[1] - p.velocity[2]))};
  }
};

/// -dF/dx or -dF/dv of n particles, each column the product with one direction, at the state of the last force.
Eigen::MatrixXd columns(ElementJacobian& jacobian, int n, int dimension, ElementJacobian::By by) {
  Eigen::MatrixXd all(n * dimension, n * dimension);
  const Coordinates<double> zero = Coordinates<double>::Zero(n, dimension);
  for (int column = 0; column < all.cols(); ++column) {
    Coordinates<double> along = zero;
    along(column / dimension, column % dimension) = 1;
    const Coordinates<double> f =
        by == ElementJacobian::By::position ? jacobian.product(along, zero) : jacobian.product(zero, along);
    for (int row = 0; row < all.rows(); ++row) all(row, column) = -f(row / dimension, row % dimension);
  }
  return all;
}

TEST(ElementTangents, AddUpToTheJacobianOfTheSystem) {
  // 300 tetrahedra, more than run at once, beside others: internal and external, of one to four, and of velocities.
  Uniform random(3);
  const int n = 40;
  System<double> system(3, std::vector<double>(n, 1.0));
  State<double> state{0.3, Coordinates<double>(n, 3), Coordinates<double>(n, 3)};
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      state.position(i, c) = random(-1, 1);
      state.velocity(i, c) = random(-1, 1);
    }
  std::vector<std::array<int, 4>> fours;
  std::vector<std::array<double, 2>> volumes;
  for (int e = 0; e < 300; ++e) {
    const int i = e % n, step = 1 + e / n;
    fours.push_back({i, (i + step) % n, (i + 2 * step + 1) % n, (i + 3 * step + 2) % n});
    volumes.push_back({random(0.5, 2.0), random(0.0, 0.3)});
  }
  system.add<Tetrahedron>(fours, volumes);
  system.add<AngleByHand>({{0, 1, 2}, {5, 6, 7}}, {{0.3, 0.2}});
  system.add<Anchors>({{3, 4}}, {{0.7}});
  system.add<Spring>({{8, 9}, {9, 10}}, {{2.0, 0.4}});
  system.add<Gravity>({{11, 12}}, {{0.3}});
  system.add<Drag>({{13}}, {{0.3}});
  system.add<Viscous>({{1, 5, 20}, {7, 20, 13}}, {{0.4}});
  const Model<double> model(system);

  ElementJacobian jacobian(model, [](auto) { return true; });
  jacobian.force(state);
  const Eigen::MatrixXd truth = columns(jacobian, n, 3, ElementJacobian::By::position);
  // Up to some 30 elements at a particle, each of at most the largest sum, are added up in another order.
  const double tolerance = 64 * 0x1p-53 * truth.cwiseAbs().rowwise().sum().maxCoeff();
  EXPECT_LE((whole_tangent(model, state) - truth).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_GT(truth.cwiseAbs().maxCoeff(), 0.1);

  // The same by the derivatives of the system, of which only some columns are asked for; and by velocities.
  for (const auto by : {ElementJacobian::By::position, ElementJacobian::By::velocity}) {
    ElementJacobian some(model, [](auto) { return true; }, [](int particle) { return particle % 3 != 0; });
    some.force(state);
    std::vector<JacobianEntry> entries;
    some.derivatives(by, entries);
    Eigen::MatrixXd rest = columns(jacobian, n, 3, by);
    EXPECT_GT(rest.cwiseAbs().maxCoeff(), 0.1);
    for (int i = 0; i < n; i += 3) rest.middleCols(3 * i, 3).setZero();
    for (const JacobianEntry& entry : entries) rest(entry.row, entry.column) += entry.value;
    EXPECT_LE(rest.cwiseAbs().maxCoeff(), tolerance);
  }
}

// ---- bodies ------------------------------------------------------------------------------------------------

/// The frequencies [rad/s] of a box at rest, of 1e5 Pa and 1000 kg/m^3, held at x = 0.
std::vector<double> held_frequencies(const std::array<int, 3>& cells, const std::array<double, 3>& lengths,
                                     double poisson) {
  const auto box = jetlag::box(lengths, cells);
  System<double> system = elastic(box, 1e5, poisson, 1000);
  for (int i = 0; i < box.position.rows(); ++i)
    if (box.position(i, 0) == 0) system.fix(i);
  const Model<double> model(system);
  std::vector<double> omega;
  for (const double square : eigenvalues(over_masses(whole_tangent(model, at_rest(box)), model)))
    if (square > 1.0) omega.push_back(std::sqrt(square));  // the fixed ones are at 0
  return omega;
}

double nearest(const std::vector<double>& all, double value) {
  return *std::ranges::min_element(all, {}, [&](double one) { return std::abs(one - value); });
}

TEST(ElementTangents, HaveTheLongitudinalModeOfABar) {
  // Numbers of an independent program, to all their digits; pi/2 sqrt(E / rho) / L = 15.70796327 in the limit.
  EXPECT_NEAR(nearest(held_frequencies({2, 1, 1}, {1, 0.5, 0.5}, 0.0), 15.0), 15.01502830, 1e-8);
  EXPECT_NEAR(nearest(held_frequencies({4, 2, 2}, {1, 0.5, 0.5}, 0.0), 15.56), 15.56352264, 1e-8);
}

TEST(ElementTangents, HaveTheModesOfACantilever) {
  const auto coarse = held_frequencies({5, 1, 1}, {1, 0.2, 0.2}, 0.3),
             fine = held_frequencies({10, 2, 2}, {1, 0.2, 0.2}, 0.3);
  EXPECT_NEAR(coarse.front(), 3.533498246, 1e-8);  // rounding: 1e-16 omega_max^2 / omega_1 = 1e-12
  EXPECT_NEAR(coarse.back(), 181.439, 5e-4);       // as many digits as are given
  EXPECT_NEAR(fine.front(), 2.548482468, 1e-8);
  EXPECT_NEAR(fine.back(), 350.214, 5e-4);
}

TEST(ElementTangents, AreNotFiniteWhereAForceHasNoDerivative) {
  System<double> system(3, {1.0, 2.0});
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  const State<double> state{0.0, Coordinates<double>::Zero(2, 3), Coordinates<double>::Zero(2, 3)};
  ElementTangents tangents(Model<double>(system).laws()[0]);
  tangents.take(state);
  EXPECT_FALSE(tangents.of(0).allFinite());
}

}  // namespace
}  // namespace jetlag::testing::element_tangents_test
