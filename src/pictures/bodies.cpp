// SPDX-License-Identifier: MIT
// Snapshots of a solid body, in space or in the plane: its surface, far triangles first, each one lit by a lamp above the viewer's left
// shoulder.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pictures/film.hpp"
#include "pictures/support.hpp"

namespace jetlag {

namespace {

using Points = std::vector<Eigen::Vector3d>;  // on the screen
using Triangle = std::array<int, 3>;

const Eigen::Vector3d lamp = Eigen::Vector3d(-0.42, 0.78, 0.55).normalized();  // towards it, on the screen
constexpr Colour shade = colour(0x27344d), floor_shadow = colour(0xe6e9ed), stone = colour(0xc9ccd1);

/// Whether every edge is passed once in each direction: then only the outside is ever seen.
bool closed(const std::vector<Triangle>& surface) {
  std::map<std::array<int, 2>, int> passed;
  for (const auto& [a, b, c] : surface)
    for (const auto& [from, to] : {std::array{a, b}, {b, c}, {c, a}}) {
      if (from < to) ++passed[{from, to}];
      if (from > to) --passed[{to, from}];
    }
  return std::ranges::all_of(passed, [](const auto& edge) { return edge.second == 0; });
}

/// One triangle or one mark of a snapshot, to be drawn in the order of their depths.
struct Part {
  double depth;
  int triangle = -1, mark = -1;
};

Colour lit(const Colour& own, const Eigen::Vector3d& normal) {
  const double light = 0.56 + 0.50 * std::max(0.0, normal.dot(lamp)) + 0.08 * normal.z();
  const Colour dark = mixed(shade, own, 0.25);
  return light < 1.0 ? mixed(dark, own, light) : mixed(own, white, std::min(1.0, 1.2 * (light - 1.0)));
}

/// A triangle with thin darker edges: it is drawn twice, the second time a little smaller about its incentre.
/// (Lines would not be hidden by what is in front of them.)
void draw_triangle(Canvas& canvas, const std::array<Point, 3>& corners, const Colour& colour) {
  const auto& [a, b, c] = corners;
  const double at_a = (b - c).norm(), at_b = (c - a).norm(), at_c = (a - b).norm();
  const double around = at_a + at_b + at_c;
  const double area = std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
  if (area == 0.0) return;
  const Point centre = (at_a * a + at_b * b + at_c * c) / around;
  const double inradius = 2 * area / around;
  constexpr double edge = 0.45;  // [px], half of it on each side
  const double size = 1.0 - std::min(edge / inradius, 0.3);
  canvas.polygon({a, b, c}, mixed(colour, shade, 0.22));
  canvas.polygon({centre + size * (a - centre), centre + size * (b - centre), centre + size * (c - centre)},
                 colour);
}

/// Where the light through a point meets the floor, seen on the screen.
struct Floor {
  Eigen::Vector3d up, point;  // on the screen

  Floor(const Shape& shape, const Support& support, const Camera& camera)
      : up(camera(Eigen::RowVector3d(shape.up[0], shape.up[1], shape.up[2]))), point(support.height * up) {}

  Eigen::Vector3d shadow(const Eigen::Vector3d& of) const {
    return of - lamp * (up.dot(of - point) / up.dot(lamp));
  }
};

bool casts_shadow(const Shape& shape, const Support& support) {
  return shape.dimension == 3 && support.kind == Support::floor;
}

/// Draws one frame of a body into a panel of a strip.
class Painter {
 public:
  Painter(const Shape& shape, const Support& support, const Camera& camera)
      : shape_(shape),
        support_(support),
        camera_(camera),
        closed_(closed(shape.surface)),
        held_(shape.particles) {
    for (const int i : shape.fixed) held_[static_cast<std::size_t>(i)] = true;
  }

  void draw(Strip& strip, std::size_t panel, const Frame& frame, double fastest) const {
    const Points points = camera_.all(frame.position);
    const Eigen::VectorXd speed = speeds(frame);
    const Palette palette = speed_palette();
    const auto place = [&](const Eigen::Vector3d& point) { return strip.place(panel, point); };
    support_.draw(strip, panel, camera_);
    draw_walls(strip, panel, shape_, points);
    if (casts_shadow(shape_, support_)) draw_shadow(strip, panel, points);
    for (const Part& part : visible_parts(points)) {
      if (part.mark >= 0) {
        strip.canvas.dot(place(points[index(part.mark)]), 2.2, ink);
        continue;
      }
      const Triangle& triangle = shape_.surface[index(part.triangle)];
      const auto [a, b, c] = corners(triangle, points);
      const double pace = (speed[triangle[0]] + speed[triangle[1]] + speed[triangle[2]]) / 3;
      const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
      draw_triangle(strip.canvas, {place(a), place(b), place(c)},
                    lit(is_obstacle(triangle) ? stone : palette(fastest > 0.0 ? pace / fastest : 0.0),
                        normal.z() < 0.0 ? -normal : normal));
    }
  }

 private:
  bool is_obstacle(const Triangle& triangle) const { return triangle[0] >= own_particles(shape_); }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static std::array<Eigen::Vector3d, 3> corners(const Triangle& triangle, const Points& points) {
    return {points[index(triangle[0])], points[index(triangle[1])], points[index(triangle[2])]};
  }

  void draw_shadow(Strip& strip, std::size_t panel, const Points& points) const {
    const Floor floor(shape_, support_, camera_);
    for (const Triangle& triangle : shape_.surface) {
      const auto [a, b, c] = corners(triangle, points);
      strip.canvas.polygon({strip.place(panel, floor.shadow(a)), strip.place(panel, floor.shadow(b)),
                            strip.place(panel, floor.shadow(c))},
                           floor_shadow);
    }
  }

  /// Far ones first. The back of a closed surface is never visible.
  std::vector<Part> visible_parts(const Points& points) const {
    std::vector<Part> parts;
    for (std::size_t t = 0; t < shape_.surface.size(); ++t) {
      const auto [a, b, c] = corners(shape_.surface[t], points);
      if (closed_ && (b - a).cross(c - a).z() <= 0.0) continue;
      const double depth = (a + b + c).z() / 3;
      parts.push_back({depth, static_cast<int>(t), -1});
      for (const int corner : shape_.surface[t])
        if (held_[index(corner)]) parts.push_back({std::nextafter(depth, HUGE_VAL), -1, corner});
    }
    std::ranges::sort(parts, {},
                      [](const Part& part) { return std::tuple(part.depth, part.triangle, part.mark); });
    return parts;
  }

  const Shape& shape_;
  const Support& support_;
  const Camera& camera_;
  bool closed_;
  std::vector<bool> held_;
};

}  // namespace

void draw_bodies(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                 const std::string& title) {
  const Camera camera(shape);
  const Support support(shape, frames.front());
  const Floor floor(shape, support, camera);
  const Snapshots chosen = snapshots(frames);
  Window window;
  std::vector<double> all_speeds;
  for (const std::size_t i : chosen.frames) {
    for (const Eigen::Vector3d& point : camera.all(frames[i].position)) {
      window.include(point);
      if (casts_shadow(shape, support)) window.include(floor.shadow(point));
    }
    const Eigen::VectorXd speed = speeds(frames[i]);
    for (const Triangle& triangle : shape.surface)
      for (const int corner : triangle) all_speeds.push_back(speed[corner]);
  }
  const double fastest = usual_maximum(std::move(all_speeds));

  Strip strip(title, window, chosen.times);
  const Painter painter(shape, support, camera);
  for (std::size_t panel = 0; panel < chosen.frames.size(); ++panel)
    painter.draw(strip, panel, frames[chosen.frames[panel]], fastest);
  if (fastest > 0.0) strip.legend(speed_palette(), "speed", "0", "\u2265 " + quantity(fastest, "m/s"));
  strip.canvas.save(picture);
}

}  // namespace jetlag
