// SPDX-License-Identifier: MIT
#pragma once
// Jets inside Eigen: Eigen::Matrix<Jet<double, 8>, 3, 1> has dot, norm, cross, products and decompositions.
//
// Eigen decides by comparisons. Those of jets are for small t > 0, so that a pivot t is above 0. Eigen's iterations, which
// stop when a number is small, would stop at coefficient 0: they are replaced (eigen_decompositions.hpp, eigen_svd.hpp) or
// refused.
//
//   right series    dot, cross, products, norm, stableNorm, hypotNorm, normalized, inverse, determinant; isApprox, isZero,
//                   isMuchSmallerThan, which look at all coefficients; PartialPivLU, FullPivLU, LLT, LDLT, HouseholderQR,
//                   ColPivHouseholderQR, FullPivHouseholderQR, CompleteOrthogonalDecomposition, Tridiagonalization,
//                   HessenbergDecomposition; SelfAdjointEigenSolver, GeneralizedSelfAdjointEigenSolver, JacobiSVD of
//                   their own; Quaternion, AngleAxis, Rotation2D, Transform, Hyperplane, ParametrizedLine
//   throws          SelfAdjointEigenSolver and JacobiSVD, std::domain_error, where eigenvalues or singular values that
//                   coincide at t = 0 part
//   not finite      what divides by a length or pivot that is 0, and what needs more coefficients than there are: the
//                   square of t^l, 2 l > N, is above 0 but not known, and so is its root; stableNorm of what is 0 at t = 0;
//                   slerp of quaternions that coincide at t = 0, FromTwoVectors of vectors that are opposite there
//   0 beside NaN    LDLT::solve of an indefinite matrix with a pivot 0 at t = 0, as (t 1; 1 t): what it cannot divide by is
//                   set to 0, with Success
//   no compilation  BDCSVD, EigenSolver, ComplexEigenSolver, GeneralizedEigenSolver, RealSchur, ComplexSchur, RealQZ,
//                   blueNorm, Rotation2D::slerp and smallestAngle
//   at t = 0 only   isOrthogonal
//
// A rank is that for small t > 0: NumTraits::epsilon() is 0, and a pivot that is 1e-17 by rounding counts as well, unless
// setThreshold says otherwise, which then drops a pivot t. So a matrix that is singular at t = 0 must be so without
// rounding. FullPivLU, FullPivHouseholderQR, LDLT and CompleteOrthogonalDecomposition take a pivot of which no coefficient
// but a leading 0 is known (N = 1, A_0 = 0) for 0.

#include <Eigen/Geometry>

#include "jetlag/series/comparisons.hpp"
#include "jetlag/series/eigen_decompositions.hpp"
#include "jetlag/series/eigen_svd.hpp"

namespace jetlag::detail {

/// The length of the vector of all coefficients.
template <class M>
auto length_of(const M& x) {
  using std::hypot;
  auto length = size_in_series(typename M::Scalar(0.0));
  const auto add = [&]<class U>(const auto& self, const U& u) -> void {
    if constexpr (is_jet<U>)
      for (int k = 0; k <= u.degree(); ++k) self(self, u[k]);
    else
      length = hypot(length, u);
  };
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) add(add, x(i, j));
  return length;
}

}  // namespace jetlag::detail

namespace Eigen {
template <class T, int N, jetlag::Singularities P>
struct NumTraits<jetlag::Jet<T, N, P>> : GenericNumTraits<jetlag::Jet<T, N, P>> {
  using Real = jetlag::Jet<T, N, P>;
  using NonInteger = jetlag::Jet<T, N, P>;
  using Nested = jetlag::Jet<T, N, P>;
  using Literal = T;
  static constexpr bool is_dynamic = N == jetlag::Dynamic;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = is_dynamic ? int(HugeCost) : N + 1,
    AddCost = is_dynamic ? int(HugeCost) : N + 1,
    MulCost = is_dynamic ? int(HugeCost) : (N + 1) * (N + 2) / 2
  };
  static Real epsilon() { return Real(T(0)); }
  /// That of T at a high power of t: isApprox, which reads its size, takes it for every coefficient, and a comparison does
  /// not take a series for what it is at t = 0 (FromTwoVectors, of vectors that are opposite there).
  static Real dummy_precision() {
    Real u(T(0));
    if constexpr (is_dynamic) u.resize(64);
    u[u.degree()] = T(NumTraits<T>::dummy_precision());
    return u;
  }
  static int min_exponent() = delete;  // blueNorm drops what is small at t = 0: write norm or stableNorm
};

// Mixed products of jets and plain numbers.
template <class T, int N, jetlag::Singularities P, jetlag::ScalarOf<jetlag::Jet<T, N, P>> X, class Op>
struct ScalarBinaryOpTraits<jetlag::Jet<T, N, P>, X, Op> {
  using ReturnType = jetlag::Jet<T, N, P>;
};
template <class T, int N, jetlag::Singularities P, jetlag::ScalarOf<jetlag::Jet<T, N, P>> X, class Op>
struct ScalarBinaryOpTraits<X, jetlag::Jet<T, N, P>, Op> {
  using ReturnType = jetlag::Jet<T, N, P>;
};

namespace internal {

/// The squared norm of what vanishes as t^l, 2 l > N, is 0 as far as it is known, but above 0: a sign is left of it, which
/// no decision takes for 0 and no root for its square (valuation.hpp).
template <class Func, class Evaluator, class Xpr, int Unrolling>
struct SquaredNormOfJets {
  using Scalar = typename Evaluator::Scalar;
  template <class X>
  static Scalar run(const Evaluator& squares, const Func& add, const X& x) {
    Scalar sum = sum_of(squares, add, x);
    if (!sum.is_constant() && jetlag::valuation(sum) > sum.degree()) {
      const evaluator<typename remove_all<Xpr>::type> vector(x.nestedExpression());
      for (Index i = 0; i < x.rows(); ++i)
        for (Index j = 0; j < x.cols(); ++j) {
          const Scalar u = vector.coeff(i, j);
          const int l = jetlag::valuation(u);
          if (l <= u.degree() && 2 * l > sum.degree())
            sum[sum.degree()] = jetlag::detail::beyond_what_is_known<typename Scalar::value_type>();
        }
    }
    return sum;
  }

 private:
  /// In the order of Eigen.
  template <class X>
  static Scalar sum_of(const Evaluator& squares, const Func& add, const X& x) {
    if constexpr (Unrolling == CompleteUnrolling) {
      return redux_novec_unroller<Func, Evaluator, 0, Evaluator::SizeAtCompileTime>::run(squares, add);
    } else {
      Scalar sum = squares.coeffByOuterInner(0, 0);
      for (Index i = 1; i < x.innerSize(); ++i) sum = add(sum, squares.coeffByOuterInner(0, i));
      for (Index o = 1; o < x.outerSize(); ++o)
        for (Index i = 0; i < x.innerSize(); ++i) sum = add(sum, squares.coeffByOuterInner(o, i));
      return sum;
    }
  }
};

template <class J, class Xpr>
  requires jetlag::is_jet<J>
struct redux_impl<scalar_sum_op<J, J>, redux_evaluator<CwiseUnaryOp<scalar_abs2_op<J>, Xpr>>,
                  DefaultTraversal, NoUnrolling>
    : SquaredNormOfJets<scalar_sum_op<J, J>, redux_evaluator<CwiseUnaryOp<scalar_abs2_op<J>, Xpr>>, Xpr,
                        NoUnrolling> {};
template <class J, class Xpr>
  requires jetlag::is_jet<J>
struct redux_impl<scalar_sum_op<J, J>, redux_evaluator<CwiseUnaryOp<scalar_abs2_op<J>, Xpr>>,
                  DefaultTraversal, CompleteUnrolling>
    : SquaredNormOfJets<scalar_sum_op<J, J>, redux_evaluator<CwiseUnaryOp<scalar_abs2_op<J>, Xpr>>, Xpr,
                        CompleteUnrolling> {};

/// Substitution. Eigen's leaves out rows whose right side is 0; a series that is 0 as far as it is known, over a pivot
/// t, is known to one coefficient less.
template <class J, int Mode, bool IsRowMajor>
struct SubstitutionOfJets {
  template <class Index>
  static void run(Index size, const J* matrix, Index stride, J* x) {
    constexpr bool is_lower = Mode & Lower;
    for (Index step = 0; step < size; ++step) {
      const Index i = is_lower ? step : size - 1 - step;
      for (Index j = is_lower ? 0 : i + 1; j < (is_lower ? i : size); ++j)
        x[i] -= matrix[IsRowMajor ? i * stride + j : j * stride + i] * x[j];
      if constexpr (!(Mode & UnitDiag)) x[i] /= matrix[i * stride + i];
    }
  }
};
template <class J, class Index, int Mode, bool Conjugate>
  requires jetlag::is_jet<J>
struct triangular_solve_vector<J, J, Index, OnTheLeft, Mode, Conjugate, RowMajor>
    : SubstitutionOfJets<J, Mode, true> {};
template <class J, class Index, int Mode, bool Conjugate>
  requires jetlag::is_jet<J>
struct triangular_solve_vector<J, J, Index, OnTheLeft, Mode, Conjugate, ColMajor>
    : SubstitutionOfJets<J, Mode, false> {};

// Nearly equal: in all coefficients.

template <class J>
  requires jetlag::is_jet<J>
struct scalar_fuzzy_impl<J> {
  template <class Other>
  static bool isMuchSmallerThan(const J& x, const Other& y, const J& precision) {
    using jetlag::detail::size_in_series;
    return size_in_series(x) <= size_in_series(y) * size_in_series(precision);
  }
  static bool isApprox(const J& x, const J& y, const J& precision) {
    using jetlag::detail::size_in_series;
    return size_in_series(J(x - y)) <=
           std::min(size_in_series(x), size_in_series(y)) * size_in_series(precision);
  }
  static bool isApproxOrLessThan(const J& x, const J& y, const J& precision) {
    return x <= y || isApprox(x, y, precision);
  }
};

template <jetlag::detail::MatrixOfJets X, class Y>
struct isApprox_selector<X, Y, false> {
  static bool run(const X& x, const Y& y, const typename X::Scalar& precision) {
    using jetlag::detail::size_in_series, jetlag::detail::length_of;
    const typename X::PlainObject a = x, b = y;
    const typename X::PlainObject difference = a - b;
    return length_of(difference) <= size_in_series(precision) * std::min(length_of(a), length_of(b));
  }
};
template <jetlag::detail::MatrixOfJets X, class Y>
struct isMuchSmallerThan_object_selector<X, Y, false> {
  static bool run(const X& x, const Y& y, const typename X::Scalar& precision) {
    using jetlag::detail::size_in_series, jetlag::detail::length_of;
    return length_of(x.eval()) <= size_in_series(precision) * length_of(y.eval());
  }
};
template <jetlag::detail::MatrixOfJets X>
struct isMuchSmallerThan_scalar_selector<X, false> {
  static bool run(const X& x, const typename X::Scalar& y, const typename X::Scalar& precision) {
    using jetlag::detail::size_in_series, jetlag::detail::length_of;
    return length_of(x.eval()) <= size_in_series(precision) * size_in_series(y);
  }
};

}  // namespace internal
}  // namespace Eigen
