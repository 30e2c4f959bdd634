// SPDX-License-Identifier: MIT
// The orbits of a few bodies, fading into the past. Between frames they follow the cubic that has the
// positions and the velocities of both ends (Hermite's).
#include "pictures/film.hpp"

namespace jetlag {

namespace {

/// The position after a share s of the way from one frame to the next.
Coordinates<double> between(const Frame& from, const Frame& to, double s) {
  const double h = to.time - from.time;
  const double left = (1 + 2 * s) * (1 - s) * (1 - s), right = s * s * (3 - 2 * s);
  return left * from.position + right * to.position + h * s * (1 - s) * (1 - s) * from.velocity -
         h * s * s * (1 - s) * to.velocity;
}

}  // namespace

void draw_orbits(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                 const std::string& title) {
  constexpr int pieces = 8;
  const Camera camera(shape);
  std::vector<std::vector<Eigen::Vector3d>> path = {camera.all(frames.front().position)};
  for (std::size_t f = 0; f + 1 < frames.size(); ++f)
    for (int s = 1; s <= pieces; ++s)
      path.push_back(camera.all(between(frames[f], frames[f + 1], double(s) / pieces)));

  Window window;
  for (const auto& points : path)
    for (const auto& point : points) window.include(point);
  Strip strip(title, window, {frames.back().time});
  const auto place = [&](std::size_t moment, std::size_t body) { return strip.place(0, path[moment][body]); };
  const auto bodies = static_cast<std::size_t>(own_particles(shape));
  draw_walls(strip, 0, shape, path.front());
  for (std::size_t moment = 0; moment + 1 < path.size(); ++moment)
    for (std::size_t body = 0; body < bodies; ++body) {
      const double youth = double(moment) / double(path.size());
      strip.canvas.line(place(moment, body), place(moment + 1, body),
                        mixed(white, body_colour(body), 0.12 + 0.88 * youth * youth), 3.2);
    }
  for (std::size_t body = 0; body < bodies; ++body) {
    strip.canvas.dot(place(path.size() - 1, body), 12, white);
    strip.canvas.dot(place(path.size() - 1, body), 10, body_colour(body));
  }
  strip.canvas.save(picture);
}

}  // namespace jetlag
