// SPDX-License-Identifier: MIT
#include "support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace jetlag::testing {

double spectral_radius(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues().cwiseAbs().maxCoeff(); }

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) { return eigenvalues(symmetric).maxCoeff(); }

}  // namespace jetlag::testing
