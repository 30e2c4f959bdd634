// SPDX-License-Identifier: MIT
#pragma once
// Eigenvalues of small matrices of numbers, as a reference. Eigen's iterations are compiled once, in eigenvalues.cpp: each
// file that calls Eigen itself compiles them again.

#include <Eigen/Core>

namespace jetlag::testing {

/// The largest |eigenvalue| of any square matrix.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// Those of a symmetric matrix, of which the lower triangle is read, ascending; and the largest.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

}  // namespace jetlag::testing
