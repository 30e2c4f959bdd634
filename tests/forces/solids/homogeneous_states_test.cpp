// SPDX-License-Identifier: MIT
// Bodies that are deformed in the same way everywhere: what textbooks solve by hand.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "forces/solids/bodies.hpp"
#include "jetlag/output/shape.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "support/random.hpp"

namespace jetlag::testing::homogeneous_states_test {
using namespace solids;

namespace {

/// x = F X.
Coordinates<double> deformed(const Coordinates<double>& x, const Eigen::Matrix3d& f) {
  return x * f.transpose();
}

double largest(const Coordinates<double>& f) { return f.rowwise().norm().maxCoeff(); }

TEST(Patch, PullsOnItsBoundaryOnly) {  // 24 tetrahedra at a vertex, some 40 roundings of 2^-53 each: 1e-13
  auto mesh = jetlag::box({1, 1, 1}, {4, 4, 4});
  Uniform draw(3);
  std::vector<int> inside;
  for (int i = 0; i < mesh.position.rows(); ++i)
    if ((mesh.position.row(i).array() > 0).all() && (mesh.position.row(i).array() < 1).all()) {
      inside.push_back(i);
      for (int c = 0; c < 3; ++c) mesh.position(i, c) += draw(-0.05, 0.05);
    }
  ASSERT_EQ(inside.size(), 27u);
  Eigen::Matrix3d f;
  f << 1.2, 0.1, -0.05, 0.05, 0.9, 0.1, -0.1, 0.02, 1.1;
  for_each_elastic_law([&]<class L>(std::type_identity<L>) {
    const auto force = forces_at(body_of<L>(mesh, lame(young, poisson)), deformed(mesh.position, f));
    double most_inside = 0;
    for (const int i : inside) most_inside = std::max(most_inside, force.row(i).norm());
    EXPECT_LE(most_inside / largest(force), 1e-13) << L::name;
    EXPECT_GT(largest(force), 1e3) << L::name;
  });
}

/// The first Piola-Kirchhoff stress of one tetrahedron 0, e_x, e_y, e_z of volume V = 1/6: f_i = -V P e_i.
template <class L>
Eigen::Matrix3d piola(const Eigen::Matrix3d& f, const Lame<double>& lame) {
  Mesh one;
  one.position = Coordinates<double>::Zero(4, 3);
  one.position.bottomRows(3) = Eigen::Matrix3d::Identity();
  one.tetrahedra = {{0, 1, 2, 3}};
  const auto force = forces_at(body_of<L>(one, lame), deformed(one.position, f));
  return -6 * force.bottomRows(3).transpose();
}

TEST(Moduli, AreThoseOfLinearElasticity) {  // small strains: to strain / 2 and rounding 1e-16 / strain
  const double strain = 1e-6;
  const auto constants = lame(young, poisson);
  for_each_elastic_law([&]<class L>(std::type_identity<L>) {
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity(), shear = stretch;
    stretch(0, 0) += strain;
    shear(0, 1) += strain;
    const auto of_stretch = piola<L>(stretch, constants), of_shear = piola<L>(shear, constants);
    EXPECT_NEAR(of_stretch(0, 0) / strain / young, 1.346154, 1.346154e-5) << L::name;
    EXPECT_NEAR(of_stretch(1, 1) / strain / young, 1.346154 - 2 * 0.384615, 1e-5) << L::name;
    EXPECT_NEAR(of_shear(0, 1) / strain / young, 0.384615, 0.384615e-5) << L::name;
  });
}

/// Stretch l along an axis, b across it without stress there, and the pull P_11 / E. Given to 15 digits; the stresses are
/// sums of some tens of numbers near lambda, up to 170 E for nu = 0.499: 1e-12.
template <class L>
void expect_uniaxial(double nu, double l, double b, double pull) {
  SCOPED_TRACE(std::string(L::name) + ", stretch " + std::to_string(l));
  const Eigen::Matrix3d stress = piola<L>(Eigen::Vector3d(l, b, b).asDiagonal(), lame(young, nu)) / young;
  EXPECT_NEAR(stress(0, 0), pull, 1e-12);
  EXPECT_NEAR(stress(1, 1), 0, 1e-12);
  EXPECT_NEAR(stress(2, 2), 0, 1e-12);
  EXPECT_NEAR((stress - Eigen::Matrix3d(stress.diagonal().asDiagonal())).norm(), 0, 1e-12);
}
TEST(UniaxialStretch, ThinsAndPulls) {
  expect_uniaxial<Stvk>(0.3, 0.6, 1.091787525116494, -0.192);
  expect_uniaxial<Stvk>(0.3, 1.5, 0.790569415042095, 0.9375);
  expect_uniaxial<NeoHookean>(0.3, 0.6, 1.154982150184155, -0.624348568746163);
  expect_uniaxial<NeoHookean>(0.3, 1.5, 0.880174591806738, 0.378280176394319);
  expect_uniaxial<StableNeoHookean>(0.3, 0.6, 1.101327990244267, -0.536436509261906);
  expect_uniaxial<StableNeoHookean>(0.3, 1.5, 0.867086123545760, 0.404445520062712);
  expect_uniaxial<PolynomialNeoHookean>(0.3, 0.6, 1.105541596785133, -0.552706552706553);
  expect_uniaxial<PolynomialNeoHookean>(0.3, 1.5, 0.869226987360353, 0.383190883190883);
  expect_uniaxial<Corotated>(0.3, 0.6, 1.12, -0.4);  // linear: 1 - nu (l - 1), l - 1
  expect_uniaxial<Corotated>(0.3, 1.5, 0.85, 0.5);
}
TEST(UniaxialStretch, NearlyKeepsTheVolumeWhereItIsIncompressible) {
  expect_uniaxial<NeoHookean>(0.499, 1.5, 0.816768973324671, 0.351987646033836);
  expect_uniaxial<StableNeoHookean>(0.499, 1.5, 0.816745670563669, 0.366947453921554);
}

// ---- pressure ----------------------------------------------------------------------------------------------

TEST(Pressure, HoldsACompressedBody) {
  const auto mesh = jetlag::box({1, 1, 1}, {3, 3, 3});
  const auto faces = boundary(mesh.tetrahedra, mesh.position);
  const auto small = deformed(mesh.position, 0.95 * Eigen::Matrix3d::Identity());
  const std::vector<double> pressures{12828.94737, 14728.31091, 11840.08615, 11689.65081,
                                      13850.41551};  // [Pa], by hand
  int law = 0;
  for_each_elastic_law([&]<class L>(std::type_identity<L>) {
    const double p = pressures[law++];
    auto system = body_of<L>(mesh, lame(young, poisson));
    system.template add<Pressure>(faces, {{p}});
    const double on_a_vertex = p * 0.95 * 0.95 / 9 / 6;  // of one face
    // Given to 10 digits: 5e-11 of each of up to 6 faces at a vertex; what the digits leave is a pressure too.
    EXPECT_LE(largest(forces_at(system, small)), 6 * 5e-6 / p * 1.01 * on_a_vertex) << L::name;
    // The pressure that has all digits: -P_11 / l^2.
    const double exact =
        -piola<L>(0.95 * Eigen::Matrix3d::Identity(), lame(young, poisson))(0, 0) / (0.95 * 0.95);
    EXPECT_NEAR(exact, p, 5.1e-6) << L::name;
    auto balanced = body_of<L>(mesh, lame(young, poisson));
    balanced.template add<Pressure>(faces, {{exact}});
    EXPECT_LE(largest(forces_at(balanced, small)), 1e-13 * on_a_vertex) << L::name;
  });
}

TEST(Pressure, OfAClosedSurfaceNeitherPushesNorTurns) {  // 108 faces round, each 2^-53 of a force of p A / 3
  const auto mesh = jetlag::box({1, 1, 1}, {3, 3, 3});
  Uniform draw(7);
  auto x = mesh.position;
  for (double* c = x.data(); c != x.data() + x.size(); ++c) *c += draw(-0.1, 0.1);
  System<> system(3, std::vector<double>(x.rows(), 1.0));
  system.add<Pressure>(boundary(mesh.tetrahedra, mesh.position), {{6.0}});
  const auto force = forces_at(system, x);
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (int i = 0; i < x.rows(); ++i) turn += Eigen::Vector3d(x.row(i)).cross(Eigen::Vector3d(force.row(i)));
  EXPECT_LE(force.colwise().sum().norm(), 108 * 4 * 0x1p-53);
  EXPECT_LE(turn.norm(), 108 * 8 * 0x1p-53);
  // Inwards: on the bottom upwards.
  EXPECT_GT(force((1 * 4 + 1) * 4 + 0, 2), 0);
}

TEST(Traction, IsTheForceOnAnAreaAtRest) {  // an area of 1/2, wherever its corners are now
  System<> system(3, {1.0, 1.0, 1.0});
  Coordinates<double> rest(3, 3), now(3, 3);
  rest << 0, 0, 0, 0, 1, 0, 0, 0, 1;
  now << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  system.add_at_rest<Traction>({{0, 1, 2}}, rest, {{6.0, 0.0, -12.0}});
  const auto force = forces_at(system, now);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(force.row(i), Eigen::RowVector3d(1, 0, -2));
  EXPECT_THROW(system.add_at_rest<Traction>({{0, 1, 2}}, Coordinates<double>::Zero(3, 3), {{1.0, 0.0, 0.0}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::homogeneous_states_test
