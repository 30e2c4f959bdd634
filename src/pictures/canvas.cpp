// SPDX-License-Identifier: MIT
// The canvas, in the language of gnuplot: each layer is a block of data and a plot of it.
#include "pictures/canvas.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "pictures/gnuplot.hpp"

namespace jetlag {

namespace {

void append(std::string& points, const Point& point, const Colour& colour) {
  fmt::format_to(std::back_inserter(points), "{:.2f} {:.2f} {}\n", point.x(), point.y(), colour.code());
}

}  // namespace

std::string& Canvas::layer(const std::string& style) {
  if (layers_.empty() || layers_.back().style != style) layers_.push_back({style, {}});
  return layers_.back().points;
}

void Canvas::polygon(const std::vector<Point>& corners, const Colour& colour) {
  std::string& points = layer("filledcurves closed linecolor rgb variable");
  for (const Point& corner : corners) append(points, corner, colour);
  points += '\n';
}

void Canvas::line(const Point& from, const Point& to, const Colour& colour, double thickness) {
  std::string& points = layer(fmt::format("lines linewidth {:.2f} linecolor rgb variable", thickness));
  append(points, from, colour);
  append(points, to, colour);
  points += '\n';
}

void Canvas::dot(const Point& centre, double radius, const Colour& colour) {
  std::vector<Point> corners(static_cast<std::size_t>(std::clamp(6.0 * radius, 12.0, 48.0)));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * double(i) / double(corners.size());
    corners[i] = centre + radius * Point(std::cos(angle), std::sin(angle));
  }
  polygon(corners, colour);
}

void Canvas::text(const Point& at, const std::string& text, double size, const Colour& colour, Align align) {
  constexpr const char* names[] = {"left", "center", "right"};
  texts_ +=
      fmt::format("set label {} at {:.2f},{:.2f} {} font ',{:.0f}' textcolor rgb 0x{:06x} noenhanced front\n",
                  gnuplot::quoted(text), at.x(), at.y(), names[static_cast<int>(align)], size, colour.code());
}

void Canvas::save(const std::filesystem::path& picture) const {
  std::string script = fmt::format(
      "set margins 0, 0, 0, 0\nunset border\nunset tics\nunset key\nset style fill solid noborder\n"
      "set xrange [0:{0:.2f}]\nset yrange [0:{1:.2f}]\n",
      width_, height_);
  script += texts_;
  std::string plots;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    script += fmt::format("$layer{} << END\n{}END\n", i, layers_[i].points);
    plots += fmt::format("{} $layer{} using 1:2:3 with {}", i == 0 ? "plot" : ", \\\n ", i, layers_[i].style);
  }
  gnuplot::draw(picture, {width_, height_}, script + (plots.empty() ? "plot -1" : plots));
}

}  // namespace jetlag
