// SPDX-License-Identifier: MIT
// The corotated law against a polar decomposition that knows nothing of invariants, and where that jumps.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <optional>

#include "forces/solids/bodies.hpp"
#include "jetlag/model/energy.hpp"
#include "support/random.hpp"

namespace jetlag::testing::corotated_test {
using namespace solids;

namespace {

using Eigen::Matrix3d;
constexpr Lame<double> constants{3, 2};

/// A tetrahedron, and what it is when deformed: x = F X.
struct Tetrahedron {
  Mesh mesh;
  System<double> system;

  Tetrahedron() : mesh(rest()), system(body_of<Corotated>(mesh, constants)) {}
  static Mesh rest() {
    Mesh one;
    one.position.resize(4, 3);
    one.position << 0, 0, 0, 1, 0, 0, 0.2, 0.9, 0, 0.3, 0.2, 0.8;
    one.tetrahedra = {{0, 1, 2, 3}};
    return one;
  }
  Coordinates<double> at(const Matrix3d& f) const { return mesh.position * f.transpose(); }
  Coordinates<double> forces(const Matrix3d& f) const { return forces_at(system, at(f)); }
  double energy(const Matrix3d& f) const {
    EnergyMeter meter{Model<double>(system)};
    return meter({0.0, at(f), Coordinates<double>::Zero(4, 3)}).total();
  }
};

/// The rotation next to F, by singular values of which the smallest takes the sign of det F.
Matrix3d rotation_next_to(const Matrix3d& f) {
  const Eigen::JacobiSVD<Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d turn = svd.matrixU();
  if ((turn * svd.matrixV().transpose()).determinant() < 0) turn.col(2) = -turn.col(2);
  return turn * svd.matrixV().transpose();
}

Matrix3d random_turn(Uniform& draw) {
  return Eigen::AngleAxisd(draw(0, 3), Eigen::Vector3d(draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized())
      .toRotationMatrix();
}

/// F with these principal stretches between two random turns.
Matrix3d stretched(const Eigen::Vector3d& stretches, Uniform& draw) {
  const Matrix3d first = random_turn(draw);
  return random_turn(draw) * stretches.asDiagonal() * first;
}

/// f_i = -V P B^T e_i and E, with P = 2 mu (F - R) + lambda tr(R^T F - 1) R. Invariants round by 2^-53 of up to 20; a sum
/// of stretches is that over q, and forces are up to 10 of them: 1e-13 leaves a factor of some 10 at q > 0.3.
void expect_singular_values(const Matrix3d& f) {
  const Tetrahedron one;
  const Matrix3d turn = rotation_next_to(f), edges = one.mesh.position.bottomRows(3).transpose();
  const double strain = (turn.transpose() * f).trace() - 3, volume = edges.determinant() / 6;
  const Matrix3d stress = 2 * constants.mu * (f - turn) + constants.lambda * strain * turn;
  const Matrix3d expected = -volume * stress * edges.inverse().transpose();
  const auto force = one.forces(f);
  EXPECT_LE((force.bottomRows(3).transpose() - expected).norm(), 1e-13) << f;
  EXPECT_NEAR(one.energy(f),
              volume * (constants.mu * (f - turn).squaredNorm() + constants.lambda / 2 * strain * strain),
              1e-13)
      << f;
}

TEST(Corotated, IsThatOfSingularValues) {
  Uniform draw(5);
  for (int i = 0; i < 50; ++i)
    expect_singular_values(stretched({draw(0.5, 1.5), draw(0.5, 1.5), draw(0.5, 1.5)}, draw));
}
TEST(Corotated, IsThatOfSingularValuesInsideOut) {
  Uniform draw(6);
  for (int i = 0; i < 50; ++i)
    expect_singular_values(stretched({draw(1, 1.5), draw(0.7, 1.5), draw(-0.3, 0)}, draw));
}
TEST(Corotated, IsThatOfSingularValuesWhereItIsFlat) {
  expect_singular_values(Eigen::Vector3d(1.2, 0.8, 0).asDiagonal());
}

TEST(Corotated, FeelsNoRotation) {  // 1e-14: some 40 roundings of 2^-53 of forces that add up to nothing
  Uniform draw(7);
  const Tetrahedron one;
  const Matrix3d f = stretched({1.3, 0.9, 0.7}, draw);
  const auto force = one.forces(f);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d turn = random_turn(draw);
    EXPECT_LE(one.forces(turn).norm(), 1e-14);
    EXPECT_LE((one.forces(turn * f) - force * turn.transpose()).norm(), 2e-14);
    EXPECT_NEAR(one.energy(turn * f), one.energy(f), 1e-14);
  }
}

/// The apex of a tetrahedron 0, e_x, e_y/2, z e_z, at rest for y = z = 1, so heavy that it keeps its speed of -1 m/s.
Expansion<> through_itself(System<double>& system, double z) {
  Coordinates<double> rest = Coordinates<double>::Zero(4, 3), now = rest, speed = rest;
  rest.bottomRows(3) = Matrix3d::Identity();
  system = System<double>(3, {1.0, 1.0, 1.0, 1e15});
  system.add_at_rest<Corotated>({{0, 1, 2, 3}}, rest, {{constants.lambda, constants.mu}});
  for (int i = 0; i < 3; ++i) system.fix(i);
  now.bottomRows(3) = Eigen::Vector3d(1, 0.5, z).asDiagonal();
  speed(3, 2) = -1;
  Expansion<> motion(system, 12);
  motion.start({0.0, now, speed});
  motion.grow_to(12);
  return motion;
}

TEST(
    Corotated,
    ChangesWhereTwoStretchesAddUpToZero) {  // q = 3/2 (1 + z)(1/2 + z); beyond by its rounding over its slope of 3/4: 1e-13
  System<double> system(3, {});
  auto motion = through_itself(system, -0.3);
  double reach = 1;
  const auto change = motion.first_change(reach);
  ASSERT_TRUE(change.has_value());
  EXPECT_NEAR(*change, 0.2, 1e-13);
  auto before = through_itself(system, 0.5);
  reach = 0.9;
  EXPECT_FALSE(before.first_change(reach).has_value());
  EXPECT_EQ(reach, 0.9);
}

TEST(Corotated, HasNoForceWhereTheRotationJumps) {
  const Tetrahedron one;
  for (const Eigen::Vector3d& stretches : {Eigen::Vector3d(1, 1, -1), Eigen::Vector3d(1, 0.5, -0.5),
                                           Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0)}) {
    EXPECT_FALSE(std::isfinite(one.forces(stretches.asDiagonal())(3, 0))) << stretches.transpose();
    EXPECT_TRUE(std::isfinite(one.energy(stretches.asDiagonal()))) << stretches.transpose();
  }
}

}  // namespace
}  // namespace jetlag::testing::corotated_test
