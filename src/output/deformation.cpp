// SPDX-License-Identifier: MIT
#include "jetlag/output/deformation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace jetlag {

namespace {

template <int D>
using SquareMatrix = Eigen::Matrix<double, D, D>;

/// The edges x_i - x_0 of an element, as columns.
template <int D>
SquareMatrix<D> edges_of(const int* cell, const Coordinates<double>& x) {
  SquareMatrix<D> edges;
  for (int i = 0; i < D; ++i) edges.col(i) = (x.row(cell[i + 1]) - x.row(cell[0])).transpose();
  return edges;
}

}  // namespace

DeformationMeter::DeformationMeter(const std::vector<Solid>& solids, const Coordinates<double>& rest)
    : dimension_(static_cast<int>(rest.cols())) {
  for (const Solid& solid : solids) {
    auto place = std::ranges::find(found_, solid.law, &Deformation::law) - found_.begin();
    if (place == static_cast<std::ptrdiff_t>(found_.size())) {
      found_.push_back({solid.law});
      groups_.emplace_back();
    }
    const auto n = static_cast<std::size_t>(place);
    if (dimension_ == 3)
      add<3>(solid, rest, groups_[n], found_[n]);
    else
      add<2>(solid, rest, groups_[n], found_[n]);
  }
}

template <int D>
void DeformationMeter::add(const Solid& solid, const Coordinates<double>& rest, Group& group,
                           Deformation& found) {
  const std::size_t count = solid.cells.size() / (D + 1);
  found.count += count;
  group.cells.insert(group.cells.end(), solid.cells.begin(), solid.cells.end());
  for (std::size_t e = 0; e < count; ++e) {
    const SquareMatrix<D> edges = edges_of<D>(&solid.cells[e * (D + 1)], rest), inverse = edges.inverse();
    group.inverse.insert(group.inverse.end(), inverse.data(), inverse.data() + D * D);
    found.volume += edges.determinant() * solid.thickness / (D == 3 ? 6 : 2);
  }
}

void DeformationMeter::take(double time, const Coordinates<double>& position) {
  for (std::size_t n = 0; n < groups_.size(); ++n)
    if (dimension_ == 3)
      take<3>(time, position, groups_[n], found_[n]);
    else
      take<2>(time, position, groups_[n], found_[n]);
}

template <int D>
void DeformationMeter::take(double time, const Coordinates<double>& position, const Group& group,
                            Deformation& found) {
  std::size_t inverted = 0;
  double most = found.max_stretch * found.max_stretch;
  for (std::size_t e = 0; e < group.cells.size() / (D + 1); ++e) {
    const int* cell = &group.cells[e * (D + 1)];
    const SquareMatrix<D> f =
        edges_of<D>(cell, position) * Eigen::Map<const SquareMatrix<D>>(&group.inverse[e * D * D]);
    const double j = f.determinant();
    inverted += j <= 0;
    if (j < found.min_j || found.min_j_element.empty()) {
      found.min_j = j;
      found.min_j_time = time;
      found.min_j_element.assign(cell, cell + D + 1);
    }
    const SquareMatrix<D> c = f.transpose() * f;
    // No eigenvalue is larger than the trace: most elements need not be looked at.
    if (c.trace() > most)
      most = std::max(most, Eigen::SelfAdjointEigenSolver<SquareMatrix<D>>()
                                .computeDirect(c, Eigen::EigenvaluesOnly)
                                .eigenvalues()[D - 1]);
  }
  found.max_stretch = std::sqrt(most);
  found.inverted = std::max(found.inverted, inverted);
}

}  // namespace jetlag
