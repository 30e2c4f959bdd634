// SPDX-License-Identifier: MIT
#pragma once
// The tangents K = -dF/dx of all elements of one law, each of all forces on its participants by all their positions.
//
// Coefficient 1 of the forces along x(t) = x + t u is dF/dx u. Each element runs over rows of its own, so that one run
// along the same coordinate of the same participant of each gives a column of all tangents:
// participants * dimension runs of order 1, batch by batch, so that a batch stays in the cache.

#include <cstddef>
#include <memory>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

class ElementTangents {
 public:
  explicit ElementTangents(std::shared_ptr<const Model<double>::Law> law);

  /// Takes the tangents at a state. Velocities and the time stand still along a direction.
  void take(const State<double>& state);

  const Model<double>::Law& law() const { return *law_; }
  /// Rows and columns of a tangent: participant * dimension + component.
  int size() const { return size_; }
  /// That of an element [N/m] at the state of the last `take`; not finite where its force has no derivative. Of a law
  /// between particles the columns add up to zero, with a potential energy it is symmetric, both but for rounding.
  Eigen::Map<const Eigen::MatrixXd> of(int element) const {
    return {k_.data() + static_cast<std::size_t>(element) * size_ * size_, size_, size_};
  }

 private:
  /// Those of the elements from first on, at most batch().
  void take(const State<double>& state, int first);
  void run(int order, double time);
  int batch() const;

  std::shared_ptr<const Model<double>::Law> law_;
  int participants_, dimension_, stride_, size_;
  ElementBlocks<double> blocks_;
  std::vector<int> own_;  // the number of each participant of each element: 0, 1, ..
  AlignedVector<double> x_, v_,
      f_;                  // of a batch: orders 0 and 1, a padded row for each participant of each element
  std::vector<double> k_;  // [element][column][row]
};

}  // namespace jetlag
