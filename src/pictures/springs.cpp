// SPDX-License-Identifier: MIT
// Snapshots of springs as thin lines, far ones first; and of particles that nothing visible connects.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "pictures/film.hpp"
#include "pictures/support.hpp"

namespace jetlag {

namespace {

/// The part of the screen that the snapshots need.
Window window_of(const std::vector<Frame>& frames, const Snapshots& chosen, const Camera& camera) {
  Window window;
  for (const std::size_t i : chosen.frames)
    for (const auto& point : camera.all(frames[i].position)) window.include(point);
  return window;
}

Eigen::VectorXd lengths(const Shape& shape, const Frame& frame) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(shape.lines.size()));
  for (Eigen::Index s = 0; s < values.size(); ++s) {
    const auto& [a, b] = shape.lines[static_cast<std::size_t>(s)];
    values[s] = (frame.position.row(b) - frame.position.row(a)).norm();
  }
  return values;
}

/// Far ones first.
std::vector<std::size_t> by_depth(std::size_t count, auto depth) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(depth(i), i); });
  return order;
}

}  // namespace

void draw_springs(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                  const std::string& title) {
  const Camera camera(shape);
  const Snapshots chosen = snapshots(frames);
  const Eigen::VectorXd rest = lengths(shape, frames.front());
  const auto strains = [&](const Frame& frame) -> Eigen::VectorXd {
    return (rest.array() > 0.0).select(lengths(shape, frame).array() / rest.array() - 1.0, 0.0);
  };
  std::vector<double> sizes;
  for (const std::size_t i : chosen.frames)
    for (const double strain : strains(frames[i])) sizes.push_back(std::abs(strain));
  const double largest = usual_maximum(std::move(sizes));

  Strip strip(title, window_of(frames, chosen, camera), chosen.times);
  const Support support(shape, frames.front());
  const Palette palette = strain_palette();
  const double spacing = strip.scale() * rest.mean();  // [px]
  const double thickness = std::clamp(0.08 * spacing, 1.2, 3.2), radius = std::min(0.11 * spacing, 6.0);
  for (std::size_t panel = 0; panel < chosen.frames.size(); ++panel) {
    const Frame& frame = frames[chosen.frames[panel]];
    const auto points = camera.all(frame.position);
    const Eigen::VectorXd strain = strains(frame);
    const auto point = [&](int particle) { return points[static_cast<std::size_t>(particle)]; };
    support.draw(strip, panel, camera);
    draw_walls(strip, panel, shape, points);
    for (const std::size_t s : by_depth(shape.lines.size(), [&](std::size_t line) {
           return (point(shape.lines[line][0]) + point(shape.lines[line][1])).z();
         })) {
      const auto& [a, b] = shape.lines[s];
      const double share = strain[static_cast<Eigen::Index>(s)] / (largest > 0.0 ? largest : 1.0);
      strip.canvas.line(strip.place(panel, point(a)), strip.place(panel, point(b)),
                        palette(0.5 + 0.5 * share), thickness);
    }
    if (radius >= 1.8)
      for (int i = 0; i < own_particles(shape); ++i)
        strip.canvas.dot(strip.place(panel, point(i)), radius, mixed(ink, white, 0.15));
    for (const int i : shape.fixed)
      strip.canvas.dot(strip.place(panel, point(i)), std::max(2.5, 1.5 * radius), ink);
  }
  if (largest > 0.0)
    strip.legend(palette, "strain", fmt::format("\u2264 \u2212{:.2g} %", 100 * largest),
                 fmt::format("\u2265 +{:.2g} %", 100 * largest));
  strip.canvas.save(picture);
}

void draw_swarm(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                const std::string& title) {
  const Camera camera(shape);
  const Snapshots chosen = snapshots(frames);
  std::vector<double> all_speeds;
  for (const std::size_t i : chosen.frames)
    for (const double speed : speeds(frames[i])) all_speeds.push_back(speed);
  const double fastest = usual_maximum(std::move(all_speeds));

  Strip strip(title, window_of(frames, chosen, camera), chosen.times);
  const Palette palette = speed_palette();
  const double radius = std::clamp(60.0 / std::sqrt(double(shape.particles)), 1.5, 7.0);
  for (std::size_t panel = 0; panel < chosen.frames.size(); ++panel) {
    const Frame& frame = frames[chosen.frames[panel]];
    const auto points = camera.all(frame.position);
    const Eigen::VectorXd speed = speeds(frame);
    draw_walls(strip, panel, shape, points);
    for (const std::size_t i : by_depth(static_cast<std::size_t>(own_particles(shape)),
                                        [&](std::size_t particle) { return points[particle].z(); })) {
      const double pace = speed[static_cast<Eigen::Index>(i)] / (fastest > 0.0 ? fastest : 1.0);
      const Point centre = strip.place(panel, points[i]);
      strip.canvas.dot(centre, radius, mixed(palette(pace), ink, 0.35));
      strip.canvas.dot(centre, radius - 0.8, palette(pace));
    }
  }
  if (fastest > 0.0) strip.legend(palette, "speed", "0", "\u2265 " + quantity(fastest, "m/s"));
  strip.canvas.save(picture);
}

}  // namespace jetlag
