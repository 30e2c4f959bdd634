// SPDX-License-Identifier: MIT
// Jets as the numbers of Eigen's vectors and matrices.
#include "jetlag/series/eigen.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/close.hpp"

namespace jetlag::testing::eigen_test {
namespace {

using J = Jet<double, 4>;
using Vector3 = Eigen::Matrix<J, 3, 1>;
using Matrix3 = Eigen::Matrix<J, 3, 3>;

const J t = J::variable(0.0);
const Vector3 u(1.0 + t, 2.0 * t, J(3.0)), v(t* t, J(1.0), 2.0 - t);

// Small whole numbers throughout: equality is the test.

TEST(JetsInEigen, HaveADotProduct) { EXPECT_EQ(u.dot(v), J::from({6, -1, 1, 1})); }

TEST(JetsInEigen, HaveANorm) {  // |(3, 4) (1 + t)| = 5 (1 + t)
  const Eigen::Matrix<J, 2, 1> x(3.0 + 3.0 * t, 4.0 + 4.0 * t);
  EXPECT_EQ(x.squaredNorm(), J::from({25, 50, 25}));
  EXPECT_EQ(x.norm(), J::from({5, 5}));
}

TEST(JetsInEigen, HaveACrossProductNormalToItsFactors) {
  const Vector3 w = u.cross(v);
  EXPECT_EQ(w[2], J::from({1, 1, 0, -2}));  // u_0 v_1 - u_1 v_0
  EXPECT_EQ(w.dot(u), J(0.0));
  EXPECT_EQ(w.dot(v), J(0.0));
}

TEST(JetsInEigen, MultiplyMatrices) {
  Matrix3 shear = Matrix3::Identity();
  shear(0, 1) = t;
  EXPECT_EQ((shear * u)[0], u[0] + t * u[1]);
  EXPECT_EQ((shear * shear)(0, 1), 2.0 * t);
  EXPECT_EQ((shear * shear * shear)(0, 1), 3.0 * t);
  EXPECT_EQ((u * v.transpose())(1, 2), J::from({0, 4, -2}));
  EXPECT_EQ((u * v.transpose()).trace(), u.dot(v));
}

TEST(JetsInEigen, MixWithPlainNumbers) {
  EXPECT_EQ((2.0 * u)[0], J::from({2, 2}));
  EXPECT_EQ((u * 2.0)[0], J::from({2, 2}));
  EXPECT_EQ((u / 2.0)[1], t);
  EXPECT_EQ((t * u)[0], J::from({0, 1, 1}));
  EXPECT_EQ((u + v - u)[0], v[0]);
  const Eigen::Vector3d plain(1.0, -1.0, 2.0);
  EXPECT_EQ(u.dot(plain.cast<J>()), J::from({7, -1}));
  EXPECT_EQ((u.transpose() * plain)[0], J::from({7, -1}));
  EXPECT_EQ((Eigen::Matrix3d(Eigen::Matrix3d::Identity() * 3.0) * u)[0], J::from({3, 3}));
}

TEST(JetsInEigen, WorkInDynamicSizes) {
  Eigen::Matrix<J, Eigen::Dynamic, 1> x = Eigen::Matrix<J, Eigen::Dynamic, 1>::Constant(5, 1.0 + t);
  EXPECT_EQ(x.sum(), J::from({5, 5}));
  EXPECT_EQ(x.squaredNorm(), J::from({5, 10, 5}));
}

TEST(JetsInEigen, InvertARotationByTransposing) {  // R R^T = 1 for every coefficient
  using Tracked = Jet<RunningError<double>, 8>;
  const Tracked angle = 0.7 + Tracked::variable(0.0) * 1.3, c = cos(angle), s = sin(angle);
  Eigen::Matrix<Tracked, 2, 2> r;
  r << c, -s, s, c;
  const Eigen::Matrix<Tracked, 2, 2> one = r * r.transpose();
  EXPECT_THAT(one(0, 0), IsCloseTo(Tracked(1.0)));
  EXPECT_THAT(one(1, 1), IsCloseTo(Tracked(1.0)));
  EXPECT_THAT(r.determinant(), IsCloseTo(Tracked(1.0)));
  // R x has the length of x
  const Eigen::Matrix<Tracked, 2, 1> x(Tracked(3.0), Tracked::variable(4.0));
  EXPECT_THAT((r * x).eval().norm(), IsCloseTo(x.norm()));
}

}  // namespace
}  // namespace jetlag::testing::eigen_test
