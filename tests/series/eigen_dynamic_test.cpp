// SPDX-License-Identifier: MIT
// Eigen makes constants from 0 and 1; in dynamic jets they adapt to the series they meet. Jets of other kinds.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "jetlag/series/eigen.hpp"
#include "support/close.hpp"

namespace jetlag::testing::eigen_dynamic_test {
namespace {

using D = Jet<double, Dynamic>;
using Vector3 = Eigen::Matrix<D, 3, 1>;
using Matrix3 = Eigen::Matrix<D, 3, 3>;
static_assert(Dynamic == Eigen::Dynamic);

const D t = D::variable(0.0, 4);
const Vector3 u(1.0 + t, 2.0 * t, D(3.0)), v(t* t, D(1.0), 2.0 - t);

// Small whole numbers throughout: equality is the test.

TEST(DynamicJetsInEigen, HaveDotNormAndCross) {
  EXPECT_EQ(u.dot(v), D::from({6, -1, 1, 1, 0}));
  const Eigen::Matrix<D, 2, 1> x(3.0 + 3.0 * t, 4.0 + 4.0 * t);
  EXPECT_EQ(x.squaredNorm(), D::from({25, 50, 25, 0, 0}));
  EXPECT_EQ(x.norm(), D::from({5, 5, 0, 0, 0}));
  const Vector3 w = u.cross(v);
  EXPECT_EQ(w[2], D::from({1, 1, 0, -2, 0}));
  EXPECT_EQ(w.dot(u), D(0.0));
  EXPECT_EQ(w.dot(v), D(0.0));
}

TEST(DynamicJetsInEigen, TakeTheDegreeOfTheirSeries) {
  EXPECT_EQ((u + v).sum().degree(), 4);
  EXPECT_EQ((Matrix3::Identity() * u)[2], D(3.0));
  EXPECT_EQ((Matrix3::Identity() * u)[0], 1.0 + t);
  EXPECT_EQ((Matrix3::Zero() * u).norm(), D(0.0));
  Matrix3 shear = Matrix3::Identity();
  shear(0, 1) = t;
  EXPECT_EQ((shear * shear * shear)(0, 1), 3.0 * t);
  EXPECT_EQ(shear.determinant(), D(1.0));
  EXPECT_EQ((u * v.transpose()).trace(), u.dot(v));
  const Vector3 constant(D(3.0), D(4.0), D(0.0));
  EXPECT_TRUE(constant.norm().is_constant());
  EXPECT_EQ(constant.norm(), D(5.0));
}

TEST(DynamicJetsInEigen, MixWithPlainNumbers) {
  EXPECT_EQ((2.0 * u)[0], D::from({2, 2, 0, 0, 0}));
  EXPECT_EQ((u / 2.0)[1], t);
  EXPECT_EQ((t * u)[0], t + t * t);
  const Eigen::Vector3d plain(1.0, -1.0, 2.0);
  EXPECT_EQ(u.dot(plain.cast<D>()), D::from({7, -1, 0, 0, 0}));
  EXPECT_EQ((u.transpose() * plain)[0], D::from({7, -1, 0, 0, 0}));
}

TEST(DynamicJetsInEigen, InvertAMatrixWithWholeNumbers) {  // det = 1: the inverse of (1 + t  t; -t  1 - t)
  Eigen::Matrix<D, 2, 2> a;
  a << 1.0 + t, t, -t, 1.0 - t;
  EXPECT_EQ(a.determinant(), D(1.0));
  const Eigen::Matrix<D, 2, 2> b = a.inverse();
  EXPECT_EQ(b(0, 0), 1.0 - t);
  EXPECT_EQ(b(0, 1), -t);
  EXPECT_EQ((a * b)(0, 0), D(1.0));
  EXPECT_EQ((a * b)(1, 0), D(0.0));
}

TEST(CheckedJetsInEigen, ThrowWhereALengthHasNoSeries) {
  using C = CheckedJet<double, 4>;
  const C x = C::variable(0.0);
  using Pair = Eigen::Matrix<C, 2, 1>;
  EXPECT_EQ(known_degree(Pair(3.0 * x, 4.0 * x).norm()), 3);  // 5 t
  EXPECT_THROW(Pair(x, C(0.0)).norm() / Pair(x * x, C(0.0)).norm(), SingularPoint);
  EXPECT_EQ((2.0 * Pair(x, x))[1][1], 2.0);
}

TEST(NestedJetsInEigen, MixWithNumbersOfEveryLevel) {
  using Inner = Jet<double, 1>;
  using Outer = Jet<Inner, 3>;
  const Inner p = Inner::variable(2.0);
  const Eigen::Matrix<Outer, 2, 1> x(Outer::variable(p), Outer(1.0));
  EXPECT_EQ((x * 2.0)[0], 2.0 * Outer::variable(p));
  EXPECT_EQ((p * x)[1], Outer(p));
  EXPECT_EQ((x * p).dot(x), p * (Outer::variable(p) * Outer::variable(p) + 1.0));
  EXPECT_EQ((x / 2.0)[1], Outer(0.5));
}

}  // namespace
}  // namespace jetlag::testing::eigen_dynamic_test
