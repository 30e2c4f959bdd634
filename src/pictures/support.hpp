// SPDX-License-Identifier: MIT
#pragma once
// What holds a body: the floor it stands on, the ceiling it hangs from, or neither.

#include "pictures/film.hpp"

namespace jetlag {

struct Support {
  enum Kind { none, floor, ceiling } kind = none;
  double height = 0;  // [m], along shape.up

  /// By the height of the fixed particles in the body: its lowest quarter stands, its highest hangs.
  Support(const Shape& shape, const Frame& frame);

  /// A line above what hangs, below what stands in the plane.
  void draw(Strip& strip, std::size_t panel, const Camera& camera) const;

 private:
  std::vector<Eigen::RowVectorXd> fixed_;
  int dimension_;
};

}  // namespace jetlag
