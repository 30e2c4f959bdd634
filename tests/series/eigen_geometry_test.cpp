// SPDX-License-Identifier: MIT
// Lengths, rotations, planes and spectra of Eigen on jets: against closed forms and their own products.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/series/eigen.hpp"

namespace jetlag::testing::eigen_geometry_test {
namespace {

using J = Jet<double, 4>;
using Vector2 = Eigen::Matrix<J, 2, 1>;
using Vector3 = Eigen::Matrix<J, 3, 1>;
using Matrix2 = Eigen::Matrix<J, 2, 2>;
using Matrix3 = Eigen::Matrix<J, 3, 3>;
using Any = Eigen::Matrix<J, Eigen::Dynamic, Eigen::Dynamic>;
using Quaternion = Eigen::Quaternion<J>;
using AngleAxis = Eigen::AngleAxis<J>;

const J t = J::variable(0.0);
const Vector3 x_axis = Vector3::UnitX(), z_axis = Vector3::UnitZ();

/// Some dozens of roundings in each order, of 1 or of the largest coefficient: they are sums of products of the others.
void expect_near(const J& actual, const J& expected) {
  double size = 1;
  for (int k = 0; k <= J::degree; ++k) size = std::max(size, std::abs(expected[k]));
  for (int k = 0; k <= J::degree; ++k)
    EXPECT_NEAR(actual[k], expected[k], 256 * 0x1p-52 * size) << "coefficient " << k;
}
/// Right or not finite, and right below order `known`.
void expect_right(const J& actual, const J& expected, int known) {
  for (int k = 0; k <= J::degree; ++k) {
    if (k >= known && !std::isfinite(actual[k])) continue;
    EXPECT_NEAR(actual[k], expected[k], 256 * 0x1p-52) << "coefficient " << k;
  }
}
// Checks are compiled once for all sizes: fixed ones, unrolled and inlined, cost the compiler as much as what they check.
void expect_near_matrix(const Any& actual, const Any& expected) {
  for (Eigen::Index i = 0; i < actual.rows(); ++i)
    for (Eigen::Index j = 0; j < actual.cols(); ++j) expect_near(actual(i, j), expected(i, j));
}
Any product(const Any& a, const Any& b) { return a.lazyProduct(b); }
Any product(const Any& a, const Any& b, const Any& c) { return product(product(a, b), c); }
Any transposed(const Any& a) { return a.transpose(); }
Any diagonal(const Eigen::Matrix<J, Eigen::Dynamic, 1>& x) { return x.asDiagonal(); }
Any identity(Eigen::Index n) { return Any::Identity(n, n); }

Matrix3 positive() {
  Matrix3 a;
  a << 4.0 + t, 1.0 + t * t, t, 1.0 + t * t, 3.0 - t, 0.5 + t, t, 0.5 + t, 2.0 + t * t * t;
  return a;
}

// ---- lengths ---------------------------------------------------------------------------------------------

TEST(JetLengths, AreThoseOfTheSeries) {
  const J expected = J::from({5, .6, .064, -.00768, .000512});  // sqrt(25 + 6 t + t^2)
  expect_near(Vector2(3.0 + t, J(4.0)).stableNorm(), expected);
  expect_near(Vector2(3.0 + t, J(4.0)).norm(), expected);
  expect_near(Vector2(3.0 + t, J(4.0)).hypotNorm(), expected);
  EXPECT_FALSE(isfinite(Vector2(3.0 * t, 4.0 * t).stableNorm()));  // refused
}

TEST(JetLengths, GiveDirections) {
  const Vector2 d = Vector2(3.0 * t, 4.0 * t).normalized();
  expect_right(d[0], J(0.6), 3);  // a length 5 t and a quotient cost a coefficient each
  expect_right(d[1], J(0.8), 3);
  EXPECT_FALSE(isfinite(Vector2(3.0 * t * t * t, t * t * t).normalized()[0]));  // t^6 is not known
  EXPECT_EQ(Vector2(J(0.0), J(0.0)).normalized()[0], J(0.0));                   // as Eigen says
  using Dual = Jet<double, 1>;
  Eigen::Matrix<Dual, 2, 2> a;
  const Dual s = Dual::variable(0.0);
  a << 2.0, s, s, 1.0;
  EXPECT_EQ((a.householderQr().solve(Eigen::Matrix<Dual, 2, 1>(Dual(0.0), Dual(1.0)))[0]),
            Dual::from({0, -0.5}));
}

TEST(JetsInEigen, AreApproximateInAllCoefficients) {
  const Matrix3 a = positive();
  EXPECT_TRUE(a.isApprox(a));
  EXPECT_TRUE(a.isApprox(a * (1.0 + 1e-14)));
  EXPECT_FALSE(a.isApprox(a + t * t * t * Matrix3::Identity()));
  EXPECT_TRUE((a - a).isZero());
  EXPECT_FALSE((t * Matrix3::Identity()).isZero());
  EXPECT_TRUE((a * 1e-20).isMuchSmallerThan(a));
  EXPECT_FALSE((a * t).eval().isMuchSmallerThan(a));
}

// ---- rotations -------------------------------------------------------------------------------------------

TEST(JetRotations, AreInterpolated) {
  const Quaternion a(AngleAxis(J(0.2), z_axis)), b(AngleAxis(1.2 + t, z_axis));
  const Quaternion c = a.slerp(J(0.25), b);
  expect_near(c.w(), cos(0.5 * (0.2 + 0.25 * (1.0 + t))));
  expect_near(c.z(), sin(0.5 * (0.2 + 0.25 * (1.0 + t))));
  const Quaternion d =
      a.slerp(J(0.25), Quaternion(AngleAxis(0.2 + t, z_axis)));  // they coincide at t = 0: refused
  expect_right(d.w(), cos(0.5 * (0.2 + 0.25 * t)), 0);
  EXPECT_FALSE(isfinite(d.w()));
}

TEST(JetRotations, TakeOneVectorToAnother) {
  const Quaternion q = Quaternion::FromTwoVectors(x_axis, Vector3(cos(t), sin(t), J(0.0)));
  expect_near(q.w(), cos(0.5 * t));
  expect_near(q.z(), sin(0.5 * t));
  const Vector3 opposite(-cos(t), -sin(t), J(0.0));  // at t = 0: refused
  const Vector3 image = Quaternion::FromTwoVectors(x_axis, opposite) * x_axis;
  for (Eigen::Index i = 0; i < 3; ++i) expect_right(image[i], opposite[i], 0);
  EXPECT_FALSE(isfinite(image[1]));
}

TEST(JetRotations, AreTheirOwnOrthogonalFactor) {  // R is a diagonal of signs: sin t is not lost
  Matrix2 turn;
  turn << cos(t), -sin(t), sin(t), cos(t);
  const auto expect_factors = [&](const Matrix2& q, const Matrix2& r) {
    expect_near_matrix(product(q, r), turn);
    expect_near_matrix(product(transposed(q), q), identity(2));
    for (Eigen::Index i = 0; i < 2; ++i) {
      expect_near(abs(r(i, i)), J(1.0));
      expect_near(abs(q(i, i)), cos(t));
      expect_near(abs(q(1 - i, i)), sin(t));
    }
    expect_near(r(0, 1), J(0.0));
  };
  const Eigen::HouseholderQR<Matrix2> plain(turn);
  expect_factors(plain.householderQ(), plain.matrixQR().triangularView<Eigen::Upper>());
}

TEST(JetRotations, HaveAnAngleAndAnAxis) {
  const AngleAxis about_z{Quaternion(AngleAxis(0.5 + t, z_axis))};
  expect_near(about_z.angle(), 0.5 + t);
  expect_near(about_z.axis()[2], J(1.0));
  const AngleAxis from_rest{Quaternion(AngleAxis(t, z_axis))};
  expect_right(from_rest.angle(), t, 4);
  expect_right(from_rest.axis()[2], J(1.0), 3);
  const Vector3 axis = Vector3(1.0 + t, t, 2.0 - t).normalized();
  const Matrix3 r = AngleAxis(0.3 + t, axis).toRotationMatrix();
  expect_near_matrix(product(r, transposed(r)), identity(3));
  expect_near_matrix(Quaternion(r).toRotationMatrix(), r);
  expect_near(AngleAxis(r).angle(), 0.3 + t);
  expect_near((Eigen::Rotation2D<J>(t) * Eigen::Rotation2D<J>(1.0 + t)).angle(), 1.0 + 2.0 * t);
}

TEST(JetRotations, AreFoundInTransforms) {
  Eigen::Transform<J, 3, Eigen::Affine> a;
  a = Eigen::Translation<J, 3>(t, 1.0 + t, t * t) * AngleAxis(0.3 + t, z_axis) *
      Eigen::UniformScaling<J>(2.0 + t);
  expect_near_matrix((a.inverse() * a).matrix(), identity(4));
  expect_near_matrix(Matrix3(a.rotation()), AngleAxis(0.3 + t, z_axis).toRotationMatrix());  // by JacobiSVD
}

// ---- planes and lines ------------------------------------------------------------------------------------

TEST(JetPlanes, ContainThePointsTheyAreMadeFrom) {
  const Vector3 p(t, J(0.0), J(0.0)), q(J(0.0), J(1.0), J(0.0)), r(J(1.0), J(1.0), t);
  const auto plane = Eigen::Hyperplane<J, 3>::Through(p, q, r);
  for (const Vector3& x : {p, q, r}) expect_near(plane.signedDistance(x), J(0.0));
  const auto line = Eigen::ParametrizedLine<J, 3>::Through(p, Vector3(J(1.0), J(2.0), 2.0 + t));
  expect_near(plane.signedDistance(line.intersectionPoint(plane)), J(0.0));
}

// ---- spectra ---------------------------------------------------------------------------------------------

TEST(JetSpectra, AreThoseOfTheMatrix) {
  Matrix2 a;
  a << 2.0, 1.0, 1.0, 1.0 + t;
  const J root = sqrt(5.0 - 2.0 * t + t * t);  // of (3 + t)^2 - 4 (1 + 2 t)
  const Eigen::SelfAdjointEigenSolver<Matrix2> spectrum(a);
  expect_near(spectrum.eigenvalues()[0], 0.5 * (3.0 + t - root));
  expect_near(spectrum.eigenvalues()[1], 0.5 * (3.0 + t + root));
  const Eigen::JacobiSVD<Matrix2> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  expect_near(svd.singularValues()[0], 0.5 * (3.0 + t + root));
  expect_near(svd.singularValues()[1], 0.5 * (3.0 + t - root));

  const Matrix3 b = positive();
  const Eigen::SelfAdjointEigenSolver<Matrix3> of_b(b);
  const Matrix3 v = of_b.eigenvectors();
  expect_near_matrix(product(v, diagonal(of_b.eigenvalues()), transposed(v)), b);
  expect_near_matrix(product(transposed(v), v), identity(3));
  expect_near_matrix(product(of_b.operatorSqrt(), of_b.operatorSqrt()), b);
}

TEST(JetSpectra, OfDiagonalMatricesAreTheirEntriesInOrder) {  // they cross at 0; -t is below t soon after
  Matrix3 a = Matrix3::Zero();
  a(0, 0) = t, a(1, 1) = -t, a(2, 2) = J(-1.0);
  const Eigen::SelfAdjointEigenSolver<Matrix3> spectrum(a);
  EXPECT_EQ(spectrum.eigenvalues(), Vector3(J(-1.0), -t, t));
}

TEST(JetSpectra, RefuseWhatPartsAtTheStart) {  // 1 +- t
  Matrix2 a;
  a << 1.0, t, t, 1.0;
  EXPECT_THROW(Eigen::SelfAdjointEigenSolver<Matrix2>{a}, std::domain_error);
  EXPECT_THROW(Eigen::JacobiSVD<Matrix2>(a, Eigen::ComputeFullU), std::domain_error);
}

TEST(JetSpectra, OfRectanglesGiveTheirProducts) {
  const Any b = positive();
  for (const Any& a : {Any(b.leftCols(2)), Any(b.topRows(2)), b}) {
    const Eigen::JacobiSVD<Any> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Any s = Any::Zero(a.rows(), a.cols());
    s.diagonal() = svd.singularValues();
    expect_near_matrix(product(svd.matrixU(), s, transposed(svd.matrixV())), a);
    expect_near_matrix(product(transposed(svd.matrixU()), svd.matrixU()), identity(a.rows()));
    expect_near_matrix(product(transposed(svd.matrixV()), svd.matrixV()), identity(a.cols()));
    EXPECT_EQ(svd.rank(), std::min(a.rows(), a.cols()));
  }
}

TEST(JetSpectra, OfPairsSolveTheirEquation) {
  const Matrix3 a = positive();
  Matrix3 b;
  b << 2.0, t, 0.0, t, 2.0, 0.5, 0.0, 0.5, 1.0 + t;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3> pair(a, b);
  const Matrix3 v = pair.eigenvectors();
  expect_near_matrix(product(a, v), product(b, v, diagonal(pair.eigenvalues())));
}

TEST(JetSpectra, StartWithReflections) {
  const Any a = positive();
  const Eigen::Tridiagonalization<Any> tridiagonal(a);
  const Any q = tridiagonal.matrixQ(), band = tridiagonal.matrixT();
  expect_near_matrix(product(q, band, transposed(q)), a);
  const Eigen::HessenbergDecomposition<Any> hessenberg(a);
  const Any p = hessenberg.matrixQ(), h = hessenberg.matrixH();
  expect_near_matrix(product(p, h, transposed(p)), a);
}

// ---- what is refused -------------------------------------------------------------------------------------

template <class X>
concept Complete = requires { sizeof(X); };
static_assert(!Complete<Eigen::BDCSVD<Any>> && !Complete<Eigen::EigenSolver<Any>> &&
              !Complete<Eigen::ComplexEigenSolver<Any>> && !Complete<Eigen::GeneralizedEigenSolver<Any>> &&
              !Complete<Eigen::RealSchur<Any>> && !Complete<Eigen::ComplexSchur<Any>> &&
              !Complete<Eigen::RealQZ<Any>>);
static_assert(Complete<Eigen::BDCSVD<Eigen::MatrixXd>> && Complete<Eigen::EigenSolver<Eigen::MatrixXd>>);

}  // namespace
}  // namespace jetlag::testing::eigen_geometry_test
