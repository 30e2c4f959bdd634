// SPDX-License-Identifier: MIT
#pragma once
// The tangents K = -dF/dx of elements of one law, each of all forces on its participants by all their positions; or -dF/dv.
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
  /// Of all elements, or of those chosen by their numbers.
  explicit ElementTangents(const std::shared_ptr<const Model<double>::Law>& law)
      : ElementTangents(law, law->all()) {}
  ElementTangents(std::shared_ptr<const Model<double>::Law> law, std::vector<int> chosen);

  /// Takes the tangents at a state, by positions or by velocities; the others and the time stand still along a direction.
  void take(const State<double>& state, Input::Kind by = Input::Kind::position);

  const Model<double>::Law& law() const { return *law_; }
  const std::vector<int>& chosen() const { return chosen_; }
  bool reads_velocity() const { return blocks_.reads_velocity(); }
  /// Rows and columns of a tangent: participant * dimension + component.
  int size() const { return size_; }
  /// That of the n-th chosen element [N/m], or [N s/m], at the state of the last `take`; not finite where its force has no derivative. Of a law
  /// between particles the columns add up to zero, with a potential energy it is symmetric, both but for rounding.
  Eigen::Map<const Eigen::MatrixXd> of(int n) const {
    return {k_.data() + static_cast<std::size_t>(n) * size_ * size_, size_, size_};
  }

 private:
  /// Those from the n-th on, at most batch().
  void take(const State<double>& state, Input::Kind by, int first);
  void run(int order, double time);
  int batch() const;

  std::shared_ptr<const Model<double>::Law> law_;
  int participants_, dimension_, stride_, size_;
  ElementBlocks<double> blocks_;
  std::vector<int> chosen_;
  std::vector<int> own_;             // of each participant of each element: its row, if all were in one batch
  AlignedVector<double> x_, v_, f_;  // of a batch: orders 0 and 1, a padded row for each participant
  std::vector<double> k_;            // [chosen][column][row]
};

}  // namespace jetlag
