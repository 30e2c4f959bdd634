// SPDX-License-Identifier: MIT
#pragma once
// Linear equations of implicit methods: dense for few unknowns, sparse for many.

#include <Eigen/Core>
#include <Eigen/SparseLU>
#include <vector>

namespace jetlag {

class LinearSolver {
 public:
  using Entries = std::vector<Eigen::Triplet<double>>;
  static constexpr int dense_unknowns = 64;  // up to here

  /// A^-1 B, A: shape (n, n), the sum of its entries; B: shape (n, any). Not finite where A is singular. The order of
  /// elimination is kept as long as entries stand in the same places.
  Eigen::MatrixXd solve(int n, const Entries& entries, const Eigen::MatrixXd& b);

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace jetlag
