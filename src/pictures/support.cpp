// SPDX-License-Identifier: MIT
// The floor and the ceiling, as far as the fixed particles tell.
#include "pictures/support.hpp"

namespace jetlag {

Support::Support(const Shape& shape, const Frame& frame) : dimension_(shape.dimension) {
  if (shape.fixed.empty() || shape.dimension < 2) return;
  Eigen::VectorXd up = Eigen::VectorXd::Unit(shape.dimension, 1);
  if (shape.dimension == 3) up << shape.up[0], shape.up[1], shape.up[2];
  const Eigen::VectorXd heights = frame.position * up;
  double mean = 0, lowest = heights.maxCoeff(), highest = heights.minCoeff();
  for (const int i : shape.fixed) {
    fixed_.push_back(frame.position.row(i));
    mean += heights[i] / double(shape.fixed.size());
    lowest = std::min(lowest, heights[i]);
    highest = std::max(highest, heights[i]);
  }
  const double share = (mean - heights.minCoeff()) / (heights.maxCoeff() - heights.minCoeff());
  if (share < 0.25) kind = floor, height = lowest;
  if (share > 0.75) kind = ceiling, height = highest;
}

void Support::draw(Strip& strip, std::size_t panel, const Camera& camera) const {
  if (kind == none || (kind == floor && dimension_ == 3)) return;
  Window held;
  for (const auto& position : fixed_) held.include(camera(position));
  const double outwards = kind == ceiling ? 1 : -1;
  constexpr double overhang = 12, gap = 5, hatch = 8, thickness = 1.6;  // [px]
  const auto beam = [&](double from, double to, double screen_height) {
    const Point left = strip.place(panel, {from, screen_height, 0}) + Point(-overhang, outwards * gap);
    const Point right = strip.place(panel, {to, screen_height, 0}) + Point(overhang, outwards * gap);
    strip.canvas.line(left, right, pencil, thickness);
    for (double x = left.x(); x + hatch <= right.x(); x += hatch)
      strip.canvas.line({x, left.y()}, {x + hatch, left.y() + outwards * hatch}, mixed(pencil, white, 0.4),
                        1.0);
  };
  constexpr std::size_t few = 4;
  if (fixed_.size() > few)
    return beam(held.low.x(), held.high.x(), kind == ceiling ? held.high.y() : held.low.y());
  for (const auto& position : fixed_) {
    const Eigen::Vector3d pin = camera(position);
    beam(pin.x(), pin.x(), pin.y());
  }
}

}  // namespace jetlag
