// SPDX-License-Identifier: MIT
#pragma once
// Singular values of matrices of jets, order by order, as in eigen_decompositions.hpp. Included by eigen.hpp.
//
// A = U S V^T, U = U_0 P, V = V_0 Q:  B = U_0^T A V_0,  B Q = P S,  B^T P = Q S^T. Order k:
//
//   S_0 Q_k - P_k S_0 = X + S_k        X = sum_{j=1..k-1} P_j S_{k-j} - sum_{j=1..k} B_j Q_{k-j}
//   S_0^T P_k - Q_k S_0^T = Y + S_k^T  Y = sum_{j=1..k-1} Q_j S_{k-j}^T - sum_{j=1..k} B_j^T P_{k-j}

#include <algorithm>
#include <limits>
#include <vector>

#include "jetlag/series/eigen_decompositions.hpp"

namespace Eigen {

/// As Eigen's for numbers. Singular values are >= 0 and fall for small t > 0.
template <jetlag::detail::MatrixOfJets M, int QRPreconditioner>
class JacobiSVD<M, QRPreconditioner> {
 public:
  using MatrixType = M;
  using Scalar = typename M::Scalar;
  using RealScalar = Scalar;
  static constexpr int Rows = M::RowsAtCompileTime, Cols = M::ColsAtCompileTime;
  static constexpr int Diagonal = Rows == Eigen::Dynamic || Cols == Eigen::Dynamic ? Eigen::Dynamic
                                  : Rows < Cols                                    ? Rows
                                                                                   : Cols;
  using MatrixUType = Matrix<Scalar, Rows, Eigen::Dynamic>;
  using MatrixVType = Matrix<Scalar, Cols, Eigen::Dynamic>;
  using SingularValuesType = Matrix<Scalar, Diagonal, 1>;

  JacobiSVD() = default;
  JacobiSVD(Index, Index, unsigned int options = 0) : options_(options) {}
  explicit JacobiSVD(const M& a, unsigned int options = 0) { compute(a, options); }

  JacobiSVD& compute(const M& a) { return compute(a, options_); }
  /// Throws std::domain_error where singular values that coincide at t = 0 part, and where a matrix that is not square
  /// has a singular value 0 at t = 0 only.
  JacobiSVD& compute(const M& a, unsigned int options) {
    options_ = options;
    if (!is_threshold_set_)
      threshold_ =
          T(static_cast<double>(std::min(a.rows(), a.cols()))) * T(std::numeric_limits<T>::epsilon());
    decompose(a);
    return *this;
  }

  const SingularValuesType& singularValues() const { return values_; }
  const MatrixUType& matrixU() const { return u_; }
  const MatrixVType& matrixV() const { return v_; }
  bool computeU() const { return options_ & (ComputeFullU | ComputeThinU); }
  bool computeV() const { return options_ & (ComputeFullV | ComputeThinV); }
  Index rows() const { return rows_; }
  Index cols() const { return cols_; }
  ComputationInfo info() const { return info_; }

  JacobiSVD& setThreshold(const Scalar& threshold) {
    threshold_ = threshold;
    is_threshold_set_ = true;
    return *this;
  }
  /// As Eigen's: eps times the number of singular values unless set.
  Scalar threshold() const { return threshold_; }
  /// The number of singular values of which a coefficient is larger than threshold() times those of the largest.
  Index rank() const {
    Index count = 0;
    while (count < values_.size() &&
           jetlag::detail::size_in_series(values_[count]) >
               jetlag::detail::size_in_series(threshold_) * jetlag::detail::size_in_series(values_[0]))
      ++count;
    return count;
  }
  Index nonzeroSingularValues() const {
    Index count = 0;
    while (count < values_.size() && values_[count] != Scalar(0)) ++count;
    return count;
  }
  /// The least-squares solution of smallest norm.
  template <class D>
  Matrix<Scalar, Cols, D::ColsAtCompileTime> solve(const MatrixBase<D>& b) const {
    eigen_assert(computeU() && computeV());
    const Index r = rank();
    const Matrix<Scalar, Eigen::Dynamic, D::ColsAtCompileTime> y = u_.leftCols(r).transpose() * b;
    Matrix<Scalar, Eigen::Dynamic, D::ColsAtCompileTime> z = y;
    for (Index i = 0; i < r; ++i)
      for (Index j = 0; j < z.cols(); ++j) z(i, j) = y(i, j) / values_[i];
    return v_.leftCols(r) * z;
  }

 private:
  using T = typename Scalar::value_type;
  using Numbers = jetlag::detail::Numbers<T>;

  /// Order k of P and Q from that of  S_0 Q - P S_0 = X + S_k,  S_0^T P - Q S_0^T = Y + S_k^T.
  struct Step {
    const std::vector<T>& s;  // the singular values at t = 0
    const Numbers &x, &y, &half_p, &half_q;
    T coincide, rounding;
    int k;
    Numbers &p, &q;

    [[noreturn]] void part(Index i, Index j) const {
      jetlag::detail::throw_coincidence("JacobiSVD", "singular values", i, j, k);
    }
    bool vanishes(const T& z) const { return !(z > rounding) && !(-z > rounding); }

    void among(Index i, Index j) const {  // both have a singular value
      if (i == j) return;                 // of length 1: as it is
      const T gap = s[i] - s[j], size = gap < T(0) ? T(-gap) : gap;
      if (size > coincide) {
        const T scale = gap * (s[i] + s[j]);
        q(i, j) = (s[i] * x(i, j) + s[j] * y(i, j)) / scale;
        p(i, j) = (s[j] * x(i, j) + s[i] * y(i, j)) / scale;
      } else if (!vanishes(x(i, j) + y(i, j))) {
        part(i, j);
      } else if (s[i] > coincide) {  // only the difference of P and Q is determined
        const T d = x(i, j) / (s[i] + s[j]), e = x(j, i) / (s[i] + s[j]), both = (d + e) * T(0.5);
        q(i, j) = -half_q(i, j) + d - both;
        p(i, j) = q(i, j) - (d + d);
      } else if (!vanishes(x(i, j)) || !vanishes(y(i, j))) {
        part(i, j);
      } else {
        p(i, j) = -half_p(i, j), q(i, j) = -half_q(i, j);
      }
    }
    void beside(Index i, Index j) const {  // U has a column i without a singular value
      if (s[j] > coincide)
        p(i, j) = -x(i, j) / s[j], p(j, i) = y(j, i) / s[j];
      else if (!vanishes(x(i, j)) || !vanishes(y(j, i)))
        part(i, j);
      else
        p(i, j) = -half_p(i, j), p(j, i) = -half_p(j, i);
    }
    void below(Index i, Index j) const {  // V has a column j without a singular value
      if (s[i] > coincide)
        q(i, j) = x(i, j) / s[i], q(j, i) = -y(j, i) / s[i];
      else if (!vanishes(x(i, j)) || !vanishes(y(j, i)))
        part(i, j);
      else
        q(i, j) = -half_q(i, j), q(j, i) = -half_q(j, i);
    }
  };

  void decompose(const M& a) {
    rows_ = a.rows(), cols_ = a.cols();
    const Index m = rows_, n = cols_, r = std::min(m, n);
    auto b = jetlag::detail::orders_of<T>(a);
    const JacobiSVD<Numbers> at_zero(b[0], ComputeFullU | ComputeFullV);
    info_ = Success;
    const Numbers u = at_zero.matrixU(), v = at_zero.matrixV();
    for (Numbers& order : b) order = (u.transpose() * order * v).eval();

    std::vector<T> s_0(r);
    std::vector<Numbers> s(b.size(), Numbers::Zero(m, n)), p(b.size(), Numbers::Identity(m, m)),
        q(b.size(), Numbers::Identity(n, n));
    for (Index i = 0; i < r; ++i) s[0](i, i) = s_0[i] = at_zero.singularValues()[i];
    for (int k = 1; k < static_cast<int>(b.size()); ++k) {
      Numbers x = -b[k], y = -b[k].transpose();
      for (int j = 1; j < k; ++j) {
        x += p[j] * s[k - j] - b[j] * q[k - j];
        y += q[j] * s[k - j].transpose() - b[j].transpose() * p[k - j];
      }
      const Numbers half_p = jetlag::detail::half_of_products<T>(p, k),
                    half_q = jetlag::detail::half_of_products<T>(q, k);
      p[k] = -half_p, q[k] = -half_q;
      const Step step{s_0,
                      x,
                      y,
                      half_p,
                      half_q,
                      jetlag::detail::rounding_of<T>(b, 0),
                      jetlag::detail::rounding_of<T>(b, k),
                      k,
                      p[k],
                      q[k]};
      for (Index i = 0; i < r; ++i) s[k](i, i) = (x(i, i) + y(i, i)) * T(-0.5);
      for (Index i = 0; i < r; ++i)
        for (Index j = 0; j < r; ++j) step.among(i, j);
      for (Index i = r; i < m; ++i)
        for (Index j = 0; j < r; ++j) step.beside(i, j);
      for (Index i = 0; i < r; ++i)
        for (Index j = r; j < n; ++j) step.below(i, j);
    }
    collect(u, v, s, p, q);
  }

  /// U = U_0 P, V = V_0 Q, with values >= 0 that fall.
  void collect(const Numbers& u_0, const Numbers& v_0, const std::vector<Numbers>& s, std::vector<Numbers>& p,
               std::vector<Numbers>& q) {
    const Index r = std::min(rows_, cols_);
    for (Numbers& order : p) order = (u_0 * order).eval();
    for (Numbers& order : q) order = (v_0 * order).eval();
    using Any = Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    auto u = jetlag::detail::matrix_of<Scalar, Any>(p);
    auto v = jetlag::detail::matrix_of<Scalar, Any>(q);
    std::vector<Scalar> values;
    for (Index i = 0; i < r; ++i) {
      values.push_back(jetlag::detail::jet_of<Scalar>(s.size(), [&](int k) { return s[k](i, i); }));
      if (values.back() < Scalar(0)) {
        values.back() = -values.back();
        u.col(i) = (-u.col(i)).eval();
      }
    }
    const auto order = jetlag::detail::sorted(values, [](const Scalar& x, const Scalar& y) { return x > y; });
    values_.resize(r);
    u_ = u, v_ = v;
    for (Index i = 0; i < r; ++i) {
      values_[i] = values[order[i]];
      u_.col(i) = u.col(order[i]);
      v_.col(i) = v.col(order[i]);
    }
    if (!(options_ & ComputeFullU)) u_ = u_.leftCols(r).eval();
    if (!(options_ & ComputeFullV)) v_ = v_.leftCols(r).eval();
  }

  unsigned int options_ = 0;
  Index rows_ = 0, cols_ = 0;
  ComputationInfo info_ = InvalidInput;
  bool is_threshold_set_ = false;
  Scalar threshold_ = Scalar(0);
  SingularValuesType values_;
  MatrixUType u_;
  MatrixVType v_;
};

}  // namespace Eigen
