// SPDX-License-Identifier: MIT
#pragma once
// Eigenvalues of matrices of jets, order by order: Eigen's iterations would stop too early. Singular values: eigen_svd.hpp.
// Included by eigen.hpp.
//
// With the decomposition of A_0 by Eigen, B = V_0^T A V_0 has B_0 = L_0, a diagonal matrix. Order k of  B Q = Q L,
// Q_0 = 1, L = diag(l), is linear in what is new in it:
//
//   (l_i - l_j)_0 (Q_k)_ij - (L_k)_ij = X_ij,   X = sum_{j=1..k-1} Q_j L_{k-j} - sum_{j=1..k} B_j Q_{k-j}
//
// and that of Q^T Q = 1 gives the diagonal of Q_k. V = V_0 Q.         Source: Kato, Perturbation Theory for Linear Operators, II.
//
// Where two eigenvalues coincide at t = 0, Q_k is not determined at order k. It is taken as 0 if X_ij vanishes to rounding,
// which it does to all orders if the two coincide for all t; else std::domain_error says where they part.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/series/comparisons.hpp"

namespace jetlag::detail {

template <class T>
using Numbers = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// The coefficients of a matrix of jets, A_0 ... A_K.
template <class T, class M>
std::vector<Numbers<T>> orders_of(const M& a) {
  int degree = unlimited;
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) degree = std::min(degree, degree_of(a(i, j)));
  const int last = degree == unlimited ? 0 : degree;
  std::vector<Numbers<T>> orders(last + 1, Numbers<T>(a.rows(), a.cols()));
  for (int k = 0; k <= last; ++k)
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (Eigen::Index j = 0; j < a.cols(); ++j) orders[k](i, j) = a(i, j)[k];
  return orders;
}

/// The jet with coefficients f(0) ... f(K).
template <class J, class F>
J jet_of(std::size_t orders, F f) {
  J u = zeros<J>(J::degree_at_compile_time == Dynamic && orders == 1 ? unlimited
                                                                     : static_cast<int>(orders) - 1);
  for (int k = 0; k < static_cast<int>(orders); ++k) u[k] = f(k);
  return u;
}

template <class J, class M, class T>
M matrix_of(const std::vector<Numbers<T>>& orders) {
  M a(orders[0].rows(), orders[0].cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      a(i, j) = jet_of<J>(orders.size(), [&](int k) { return orders[k](i, j); });
  return a;
}

/// The largest coefficient of u, without its sign.
template <class U>
auto size_in_series(const U& u) {
  if constexpr (is_jet<U>) {
    auto most = size_in_series(u[0]);
    for (int k = 1; k <= u.degree(); ++k) {
      const auto size = size_in_series(u[k]);
      if (!(size <= most)) most = size;  // NaN stays
    }
    return most;
  } else {
    return U(abs(u));
  }
}

template <class T>
T largest_of(const Numbers<T>& a) {
  T most(0);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      const T size = abs(a(i, j));
      if (size > most) most = size;
    }
  return most;
}

/// What rounding makes of sums of n products of the size of the largest coefficient up to order k.
template <class T>
T rounding_of(const std::vector<Numbers<T>>& b, int k) {
  T size(0);
  for (int j = 0; j <= k; ++j) size = size + largest_of<T>(b[j]);
  const auto n = static_cast<double>(std::max(b[0].rows(), b[0].cols()));
  return T(16 * n * (k + 1)) * size * T(std::numeric_limits<T>::epsilon());
}

/// (sum_{j=1..k-1} Q_j^T Q_{k-j}) / 2: what the part of Q_k that Q^T Q = 1 determines is minus.
template <class T>
Numbers<T> half_of_products(const std::vector<Numbers<T>>& q, int k) {
  Numbers<T> sum = Numbers<T>::Zero(q[0].rows(), q[0].cols());
  for (int j = 1; j < k; ++j) sum += q[j].transpose() * q[k - j];
  return sum * T(0.5);
}

[[noreturn]] inline void throw_coincidence(const char* name, const char* what, Eigen::Index i, Eigen::Index j,
                                           int order) {
  throw std::domain_error(std::string(name) + ": " + what + " " + std::to_string(std::min(i, j)) + " and " +
                          std::to_string(std::max(i, j)) + " coincide at t = 0 and not at order " +
                          std::to_string(order) + "; their series are not computed");
}

/// x, of which the first is `first` by order, into that order.
template <class J, class Before>
std::vector<Eigen::Index> sorted(const std::vector<J>& values, Before before) {
  std::vector<Eigen::Index> order(values.size());
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return before(values[a], values[b]); });
  return order;
}

template <class J>
concept JetInEigen = is_jet<J>;

template <class M>
concept MatrixOfJets = JetInEigen<typename M::Scalar>;

}  // namespace jetlag::detail

namespace Eigen {

// Iterations that look at coefficient 0 only: no series.
template <typename MatrixType>
class EigenSolver;
template <typename MatrixType>
class ComplexEigenSolver;
template <typename MatrixType>
class GeneralizedEigenSolver;
template <typename MatrixType>
class RealSchur;
template <typename MatrixType>
class ComplexSchur;
template <typename MatrixType>
class RealQZ;
// clang-format off
template <jetlag::detail::MatrixOfJets M> class BDCSVD<M>;                  // not for jets: JacobiSVD is
template <jetlag::detail::MatrixOfJets M> class EigenSolver<M>;             // not for jets: SelfAdjointEigenSolver is
template <jetlag::detail::MatrixOfJets M> class ComplexEigenSolver<M>;      // not for jets
template <jetlag::detail::MatrixOfJets M> class GeneralizedEigenSolver<M>;  // not for jets: GeneralizedSelfAdjointEigenSolver is
template <jetlag::detail::MatrixOfJets M> class RealSchur<M>;               // not for jets
template <jetlag::detail::MatrixOfJets M> class ComplexSchur<M>;            // not for jets
template <jetlag::detail::MatrixOfJets M> class RealQZ<M>;                  // not for jets
// clang-format on

template <typename MatrixType>
class SelfAdjointEigenSolver;

/// As Eigen's for numbers; reads the lower triangle. Eigenvalues rise for small t > 0.
template <jetlag::detail::MatrixOfJets M>
class SelfAdjointEigenSolver<M> {
 public:
  using MatrixType = M;
  using Scalar = typename M::Scalar;
  using RealScalar = Scalar;
  static constexpr int Size = M::RowsAtCompileTime;
  using RealVectorType = Matrix<Scalar, Size, 1>;
  using EigenvectorsType = Matrix<Scalar, Size, Size>;

  SelfAdjointEigenSolver() = default;
  explicit SelfAdjointEigenSolver(Index) {}
  template <class D>
  explicit SelfAdjointEigenSolver(const EigenBase<D>& a, int options = ComputeEigenvectors) {
    compute(a, options);
  }

  /// Throws std::domain_error where eigenvalues that coincide at t = 0 part.
  template <class D>
  SelfAdjointEigenSolver& compute(const EigenBase<D>& matrix, int = ComputeEigenvectors) {
    const M a = matrix.derived();
    eigen_assert(a.rows() == a.cols());
    const M lower = a.template selfadjointView<Lower>();
    decompose(lower);
    return *this;
  }
  template <class D>
  SelfAdjointEigenSolver& computeDirect(const EigenBase<D>& matrix, int options = ComputeEigenvectors) {
    return compute(matrix, options);
  }

  const RealVectorType& eigenvalues() const { return values_; }
  const EigenvectorsType& eigenvectors() const { return m_eivec; }
  ComputationInfo info() const { return info_; }
  M operatorSqrt() const { return m_eivec * values_.cwiseSqrt().asDiagonal() * m_eivec.transpose(); }
  M operatorInverseSqrt() const {
    return m_eivec * values_.cwiseSqrt().cwiseInverse().asDiagonal() * m_eivec.transpose();
  }

 private:
  using T = typename Scalar::value_type;
  using Numbers = jetlag::detail::Numbers<T>;

  void decompose(const M& a) {
    auto b = jetlag::detail::orders_of<T>(a);
    const Index n = a.rows();
    const SelfAdjointEigenSolver<Numbers> at_zero(b[0]);
    info_ = at_zero.info();
    const Numbers& v = at_zero.eigenvectors();
    for (Numbers& order : b) order = (v.transpose() * order * v).eval();
    std::vector<Numbers> l(b.size(), Numbers::Zero(n, n)), q(b.size(), Numbers::Identity(n, n));
    l[0].diagonal() = at_zero.eigenvalues();
    const T coincide = jetlag::detail::rounding_of<T>(b, 0);
    for (int k = 1; k < static_cast<int>(b.size()); ++k) {
      Numbers x = -b[k];
      for (int j = 1; j < k; ++j) x += q[j] * l[k - j] - b[j] * q[k - j];
      const T rounding = jetlag::detail::rounding_of<T>(b, k);
      const Numbers half = jetlag::detail::half_of_products<T>(q, k);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const T gap = l[0](i, i) - l[0](j, j), size = gap < T(0) ? T(-gap) : gap;
          if (i == j)
            l[k](i, i) = -x(i, i), q[k](i, i) = -half(i, i);
          else if (size > coincide)
            q[k](i, j) = x(i, j) / gap;
          else if (x(i, j) > rounding || -x(i, j) > rounding)
            jetlag::detail::throw_coincidence("SelfAdjointEigenSolver", "eigenvalues", i, j, k);
          else
            q[k](i, j) = -half(i, j);
        }
    }
    for (Numbers& order : q) order = (v * order).eval();
    std::vector<Scalar> values;
    for (Index i = 0; i < n; ++i)
      values.push_back(jetlag::detail::jet_of<Scalar>(b.size(), [&](int k) { return l[k](i, i); }));
    const auto vectors = jetlag::detail::matrix_of<Scalar, EigenvectorsType>(q);
    const auto order = jetlag::detail::sorted(values, [](const Scalar& x, const Scalar& y) { return x < y; });
    values_.resize(n);
    m_eivec.resize(n, n);
    for (Index i = 0; i < n; ++i) {
      values_[i] = values[order[i]];
      m_eivec.col(i) = vectors.col(order[i]);
    }
  }

  RealVectorType values_;
  ComputationInfo info_ = InvalidInput;

 protected:
  EigenvectorsType m_eivec;  // GeneralizedSelfAdjointEigenSolver transforms it
};

}  // namespace Eigen
