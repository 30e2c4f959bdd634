// SPDX-License-Identifier: MIT
// The camera, the snapshots and the strip of panels that the films share.
#include "pictures/film.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "jetlag/pictures/pictures.hpp"
#include "pictures/gnuplot.hpp"

namespace jetlag {

namespace {

constexpr double margin = 28, header = 108, caption = 72;  // [px]
constexpr double sheet_width = 1600, highest_panel = 640, narrowest_sheet = 760;

}  // namespace

namespace {

/// The turn about one axis, by a quarter or a half, that takes `up` to the second axis.
Eigen::Matrix3d upright(const std::array<int, 3>& up) {
  const Eigen::Vector3d second(up[0], up[1], up[2]);
  const Eigen::Vector3d third =
      up[2] != 0 ? Eigen::Vector3d(0, -up[2], 0) : Eigen::Vector3d(0, 0, 1);  // what then faces the viewer
  Eigen::Matrix3d turn;
  turn << second.cross(third).transpose(), second.transpose(), third.transpose();
  return turn;
}

}  // namespace

Camera::Camera(const Shape& shape) {
  turn_ = Eigen::Matrix3d::Identity();
  if (shape.dimension < 3) return;
  constexpr double right = 28 * std::numbers::pi / 180, above = 14 * std::numbers::pi / 180;
  turn_ = Eigen::AngleAxisd(above, Eigen::Vector3d::UnitX()).matrix() *
          Eigen::AngleAxisd(-right, Eigen::Vector3d::UnitY()).matrix();
  if (shape.up != std::array{0, 1, 0}) turn_ *= upright(shape.up);
}

Eigen::Vector3d Camera::operator()(const Eigen::RowVectorXd& position) const {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  point.head(position.size()) = position.transpose();
  return turn_ * point;
}

std::vector<Eigen::Vector3d> Camera::all(const Coordinates<double>& positions) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(positions.rows()));
  for (const auto& row : positions.rowwise()) points.push_back((*this)(row));
  return points;
}

Window::Window() {
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
}

void Window::include(const Eigen::Vector3d& point) {
  low = low.cwiseMin(point.head<2>());
  high = high.cwiseMax(point.head<2>());
}

Eigen::VectorXd speeds(const Frame& frame) { return frame.velocity.rowwise().norm(); }

Snapshots snapshots(const std::vector<Frame>& frames) {
  constexpr std::size_t most = 8;  // in one row, or two, or four
  const std::size_t gaps = std::min(most, frames.size()) - 1;
  Snapshots chosen;
  for (std::size_t i = 0; i <= gaps; ++i) {
    chosen.frames.push_back(gaps == 0 ? 0 : (i * (frames.size() - 1) + gaps / 2) / gaps);
    chosen.times.push_back(frames[chosen.frames.back()].time);
  }
  return chosen;
}

double usual_maximum(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(0.98 * double(values.size() - 1));
  std::ranges::nth_element(values, place);
  return *place > 0.0 ? *place : std::ranges::max(values);
}

std::string quantity(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

struct Strip::Layout {
  std::size_t columns, rows;
  double scale, width, height;
  Eigen::Vector2d panel;  // [px]

  Layout(const Window& window, std::size_t panels) {
    // A body without extent still has a picture: the scale is that of a metre.
    const Eigen::Vector2d size = window.size();
    const double longest = size.maxCoeff() > 0.0 ? size.maxCoeff() : 1.0;
    const Eigen::Vector2d visible = size.cwiseMax(0.05 * longest);
    const double aspect = size.x() / size.y();
    columns = panels <= 4 || aspect < 0.75 ? panels : aspect < 2.6 ? (panels + 1) / 2 : 2;
    rows = (panels + columns - 1) / columns;
    const double widest_panel = (sheet_width - 2 * margin) / double(columns);
    scale = std::min(0.92 * widest_panel / visible.x(), highest_panel / visible.y());
    panel = {std::min(widest_panel, scale * visible.x() / 0.92), scale * visible.y()};
    width = std::max(narrowest_sheet, double(columns) * panel.x() + 2 * margin);
    height = header + double(rows) * (panel.y() + caption);
  }
};

Strip::Strip(const std::string& title, const Window& window, const std::vector<double>& times)
    : Strip(title, window, Layout(window, times.size()), times) {}

Strip::Strip(const std::string& title, const Window& window, const Layout& layout,
             const std::vector<double>& times)
    : canvas(layout.width, layout.height), window_(window), scale_(layout.scale) {
  canvas.text({margin, layout.height - 42}, title, 30, ink);
  const double left = (layout.width - double(layout.columns) * layout.panel.x()) / 2;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double column = double(i % layout.columns), row = double(i / layout.columns);
    corners_.emplace_back(left + column * layout.panel.x(),
                          layout.height - header - row * caption - (row + 1) * layout.panel.y());
    const Point below = corners_.back() + Point(layout.panel.x() / 2, -30);
    canvas.text(below, quantity(times[i], "s"), 24, pencil, Canvas::Align::center);
  }
  // The middle of the window is the middle of each panel.
  for (Point& corner : corners_) corner += layout.panel / 2 - scale_ * window_.size() / 2;
}

Point Strip::place(std::size_t panel, const Eigen::Vector3d& point) const {
  return corners_[panel] + scale_ * (point.head<2>() - window_.low);
}

void Strip::legend(const Palette& palette, const std::string& name, const std::string& low,
                   const std::string& high) {
  constexpr int steps = 120;
  constexpr double length = 240, thickness = 14;
  const Point start(canvas.width() - margin - length, canvas.height() - 44);
  for (int i = 0; i < steps; ++i) {
    const double from = start.x() + length * i / steps, to = start.x() + length * (i + 1) / steps;
    canvas.polygon(
        {{from, start.y()}, {to, start.y()}, {to, start.y() + thickness}, {from, start.y() + thickness}},
        palette((i + 0.5) / steps));
  }
  const double below = start.y() - 18;
  canvas.text({start.x(), below}, low, 20, pencil);
  canvas.text({start.x() - 14, start.y() + thickness / 2}, name, 20, pencil, Canvas::Align::right);
  canvas.text({start.x() + length, below}, high, 20, pencil, Canvas::Align::right);
}

void draw_walls(Strip& strip, std::size_t panel, const Shape& shape,
                const std::vector<Eigen::Vector3d>& points) {
  const double thickness = shape.dimension == 2 ? 3.0 : 1.0;  // [px]
  for (const auto& [a, b] : shape.walls)
    strip.canvas.line(strip.place(panel, points[static_cast<std::size_t>(a)]),
                      strip.place(panel, points[static_cast<std::size_t>(b)]), pencil, thickness);
}

bool can_draw() { return !gnuplot::program().empty(); }

void draw_film(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
               const std::string& title) {
  if (frames.empty()) throw std::invalid_argument("draw_film: there are no frames");
  if (shape.particles < 1) throw std::invalid_argument("draw_film: there are no particles");
  for (const Frame& frame : frames) check_frame(shape, frame);
  constexpr int few = 10;
  const bool has_surface = std::ranges::any_of(
      shape.surface, [&](const auto& triangle) { return triangle[0] < own_particles(shape); });
  const bool shows_surface = has_surface && (shape.dimension == 3 || shape.lines.empty());
  const auto draw = shape.dimension == 1          ? draw_lines
                    : shows_surface               ? draw_bodies
                    : !shape.lines.empty()        ? draw_springs
                    : own_particles(shape) <= few ? draw_orbits
                                                  : draw_swarm;
  draw(picture, shape, frames, title);
}

}  // namespace jetlag
