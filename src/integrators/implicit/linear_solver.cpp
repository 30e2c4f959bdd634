// SPDX-License-Identifier: MIT
#include "integrators/implicit/linear_solver.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace jetlag {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

bool same_places(const Sparse& a, const Sparse& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

Eigen::MatrixXd LinearSolver::solve(int n, const Entries& entries, const Eigen::MatrixXd& b) {
  if (n == 0) return b;
  if (n <= dense_unknowns) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    for (const auto& entry : entries) a(entry.row(), entry.col()) += entry.value();
    return a.partialPivLu().solve(b);
  }
  Sparse a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  if (!same_places(a, matrix_)) factors_.analyzePattern(a);
  matrix_ = std::move(a);
  factors_.factorize(matrix_);
  if (factors_.info() != Eigen::Success)
    return Eigen::MatrixXd::Constant(n, b.cols(), std::numeric_limits<double>::quiet_NaN());
  return factors_.solve(b);
}

}  // namespace jetlag
