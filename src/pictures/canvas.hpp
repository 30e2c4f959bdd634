// SPDX-License-Identifier: MIT
#pragma once
// A sheet of paper in pixels, (0, 0) at its lower left. What comes later covers what came before; texts lie
// on top.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "pictures/colours.hpp"

namespace jetlag {

using Point = Eigen::Vector2d;  // [px]

class Canvas {
 public:
  enum class Align { left, center, right };

  Canvas(double width, double height) : width_(width), height_(height) {}

  void polygon(const std::vector<Point>& corners, const Colour& colour);
  void line(const Point& from, const Point& to, const Colour& colour, double thickness = 1.0);
  void dot(const Point& centre, double radius, const Colour& colour);
  void text(const Point& at, const std::string& text, double size, const Colour& colour,
            Align align = Align::left);

  double width() const { return width_; }
  double height() const { return height_; }

  /// The picture, .png or .svg, by gnuplot.
  void save(const std::filesystem::path& picture) const;

 private:
  /// Shapes of one kind that follow each other.
  struct Layer {
    std::string style;
    std::string points;
  };
  std::string& layer(const std::string& style);

  double width_, height_;
  std::vector<Layer> layers_;
  std::string texts_;
};

}  // namespace jetlag
