// SPDX-License-Identifier: MIT
#pragma once
// What the films have in common: the camera, the choice of snapshots, and a strip of panels of one scale.

#include <string>
#include <vector>

#include "jetlag/output/shape.hpp"
#include "pictures/canvas.hpp"

namespace jetlag {

/// Parallel light rays onto a screen: right, up, and towards the viewer [m].
/// In the plane the screen is the plane; in space one looks a little from above and from the right.
class Camera {
 public:
  explicit Camera(const Shape& shape);
  Eigen::Vector3d operator()(const Eigen::RowVectorXd& position) const;
  std::vector<Eigen::Vector3d> all(const Coordinates<double>& positions) const;

 private:
  Eigen::Matrix3d turn_;
};

/// A rectangle on the screen [m].
struct Window {
  Eigen::Vector2d low, high;

  Window();
  void include(const Eigen::Vector3d& point);
  Eigen::Vector2d size() const { return high - low; }
};

/// How many particles there are without obstacles.
inline int own_particles(const Shape& shape) { return shape.particles - shape.obstacles; }

/// Speeds [m/s], one for each particle.
Eigen::VectorXd speeds(const Frame& frame);

/// Some moments of a film, evenly spaced in the list of frames, with the first and the last.
struct Snapshots {
  std::vector<std::size_t> frames;
  std::vector<double> times;  // [s]
};
Snapshots snapshots(const std::vector<Frame>& frames);

/// The value that 98 % of them do not exceed: a few outliers do not pale all the others. 0 when all are 0.
double usual_maximum(std::vector<double> values);

/// "12.5 m/s" with three digits.
std::string quantity(double value, const std::string& unit);

/// A canvas with a title, rows of equal panels, and the time below each.
class Strip {
 public:
  Strip(const std::string& title, const Window& window, const std::vector<double>& times);

  /// From the screen to the paper, in the panel with this number.
  Point place(std::size_t panel, const Eigen::Vector3d& point) const;
  double scale() const { return scale_; }  // [px/m]

  /// What the colours mean, beside the title.
  void legend(const Palette& palette, const std::string& name, const std::string& low,
              const std::string& high);

  Canvas canvas;

 private:
  struct Layout;
  Strip(const std::string& title, const Window& window, const Layout& layout,
        const std::vector<double>& times);

  Window window_;
  double scale_;
  std::vector<Point> corners_;  // lower left of each panel
};

/// The edges of obstacles in a panel; points: of all particles, on the screen.
void draw_walls(Strip& strip, std::size_t panel, const Shape& shape,
                const std::vector<Eigen::Vector3d>& points);

void draw_bodies(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                 const std::string& title);
void draw_springs(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                  const std::string& title);
void draw_orbits(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                 const std::string& title);
void draw_swarm(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                const std::string& title);
void draw_lines(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                const std::string& title);

}  // namespace jetlag
