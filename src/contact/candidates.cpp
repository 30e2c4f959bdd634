// SPDX-License-Identifier: MIT
#include "jetlag/contact/candidates.hpp"

#include <algorithm>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace jetlag {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Boxed = std::pair<Box, int>;
using Tree = bg::index::rtree<Boxed, bg::index::quadratic<16>>;

Box hull(const Box& a, const Box& b) {
  Box both = a;
  bg::expand(both, b);
  return both;
}

constexpr double steps_ahead = 32;  // that tracks are to last

Eigen::Vector3d velocity_of(const PathView& path) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  if (path.degree < 1) return v;
  const double scale = (path.weights ? path.weights[1] : 1.0) / path.unit;
  for (int d = 0; d < path.dimension; ++d) v[d] = path.c_0[path.stride + d] * scale;
  return v;
}

template <std::size_t N>
bool contains(const std::array<int, N>& members, int i) {
  return std::ranges::find(members, i) != members.end();
}

}  // namespace

Candidates::Candidates(Surface surface, const Model<double>& model, double reach, bool with_itself)
    : surface_(std::move(surface)),
      dimension_(model.dimension()),
      reach_(reach),
      fixed_(model.fixed()),
      place_(model.particles(), -1),
      tracks_(surface_.vertices().size()),
      curve_(tracks_.size(), 0) {
  const auto& vertices = surface_.vertices();
  for (std::size_t p = 0; p < vertices.size(); ++p) {
    if (vertices[p] < 0 || vertices[p] >= model.particles())
      throw std::invalid_argument("contact: particle " + std::to_string(vertices[p]) +
                                  " of the surface does not exist, there are " +
                                  std::to_string(model.particles()));
    place_[vertices[p]] = static_cast<int>(p);
  }
  if (!with_itself) body_ = bodies_of(surface_, model.particles());
}

double Candidates::cover(const MotionAhead& motion, double h, bool whole) {
  ++covered_;
  const auto& vertices = surface_.vertices();
  are_finite_ = true;
  for (std::size_t p = 0; p < vertices.size(); ++p) find_curve(p, motion.path(vertices[p]), h);
  if (!are_finite_) return h;
  bool holds = is_known_ && motion.time() + h <= until_;
  for (std::size_t p = 0; holds && p < vertices.size(); ++p)
    holds = stays(p, motion.path(vertices[p]), motion.time(), h);
  if (!holds) look(motion, whole);
  return std::min(h, until_ - motion.time());
}

bool Candidates::cover(const MotionAhead& motion, std::span<const int> updated) {
  are_finite_ = true;
  bool holds = is_known_;
  for (const int i : updated) {
    const int p = place_[i];
    if (p < 0) continue;
    const double h = motion.left(i);
    find_curve(p, motion.path(i), h);
    holds = holds && motion.time() + h <= until_ && stays(p, motion.path(i), motion.time(), h);
  }
  if (holds || !are_finite_) return false;
  for (std::size_t p = 0; p < tracks_.size(); ++p)
    if (const int i = surface_.vertices()[p]; !fixed_[i]) find_curve(p, motion.path(i), motion.left(i));
  if (are_finite_) look(motion, false);
  return are_finite_;
}

/// sum_{n>=2} w_n |x_n| (h/unit)^n.
void Candidates::find_curve(std::size_t p, const PathView& path, double h) {
  const double s = h / path.unit;
  double sum = 0, all = 0;
  for (int n = path.degree; n >= 0; --n) {
    const double* c = path.c_0 + n * path.stride;
    double size = 0;
    for (int d = 0; d < path.dimension; ++d) size += std::abs(c[d]);
    if (n >= 2) sum = sum * s + size * (path.weights ? path.weights[n] : 1.0);
    if (n < 2) all += n == 1 ? size * s : size;
  }
  curve_[p] = sum * s * s;
  are_finite_ = are_finite_ && std::isfinite(all + curve_[p]);
}

/// Whether a vertex stays in its room for h from now on.
bool Candidates::stays(std::size_t p, const PathView& path, double now, double h) const {
  const Track& track = tracks_[p];
  const double since = now - begin_;
  const Eigen::Vector3d velocity = velocity_of(path);
  double off = 0, change = 0;
  for (int d = 0; d < path.dimension; ++d) {
    const double dx = path.c_0[d] - (track.x[d] + track.v[d] * since), dv = velocity[d] - track.v[d];
    off += dx * dx;
    change += dv * dv;
  }
  return std::sqrt(off) + std::sqrt(change) * h + curve_[p] <= track.room;
}

/// Room beyond the curves of a step: a part of the edges, which are near each other in any case; twice as much where it has
/// lasted for few steps, half where for many.
void Candidates::choose_room() {
  if (looks_ > 0 && covered_ < 16) part_ = std::min(2 * part_, 0.4);
  if (covered_ > 128) part_ = std::max(part_ / 2, 0.01);
  covered_ = 0;
  double length = 0;
  const auto at = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(tracks_[place_[i]].x); };
  for (const auto& [a, b] : surface_.edges())
    length += (at(a) - at(b)).norm() / static_cast<double>(surface_.edges().size());
  room_ = std::max(reach_ / 2, part_ * length);
}

/// New tracks and rooms. They are to last for some steps; where that makes too many candidates, for less, and steps become
/// shorter if they must.
void Candidates::look(const MotionAhead& motion, bool whole) {
  const auto& vertices = surface_.vertices();
  std::fill_n(drift_, 3, 0.0);
  double h = 0;
  for (std::size_t p = 0; p < tracks_.size(); ++p) {
    Track& track = tracks_[p];
    const PathView path = motion.path(vertices[p]);
    const Eigen::Vector3d velocity = velocity_of(path);
    for (int d = 0; d < 3; ++d) {
      track.x[d] = d < dimension_ ? path.c_0[d] : 0.0;
      track.v[d] = velocity[d];
      drift_[d] += track.v[d] / static_cast<double>(tracks_.size());
    }
    if (!fixed_[vertices[p]]) h = std::max(h, motion.left(vertices[p]));
  }
  choose_room();
  ++looks_;
  for (std::size_t p = 0; p < tracks_.size(); ++p) tracks_[p].room = room_ + 2 * curve_[p];
  begin_ = motion.time();
  constexpr auto any = std::numeric_limits<std::size_t>::max();
  const std::size_t most = 64 + 24 * (surface_.edges().size() + surface_.vertices().size());
  double horizon = steps_ahead * h;
  for (int attempt = 0; !find(horizon, attempt < 20 && !(whole && horizon <= h) ? most : any); ++attempt) {
    horizon = whole ? std::max(horizon / 4, h) : horizon / 4;
    for (std::size_t p = 0; p < tracks_.size(); ++p) {
      const double part = std::min(1.0, horizon / motion.left(vertices[p]));
      tracks_[p].room = room_ + 2 * curve_[p] * part * part;
    }
  }
  until_ = begin_ + horizon;
  is_known_ = true;
}

/// Two vertices of one side move apart by no more than the fastest of them, and leave their tracks by no more than their rooms.
double Candidates::apart_until(const Stencil& stencil, double now, double reach) const {
  const auto members = stencil.particles();
  const int side = first_side(stencil.kind);
  std::array<Eigen::Vector3d, 4> x;
  double speed[2] = {}, room[2] = {};
  const Track& last = tracks_[place_[members.back()]];
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Track& track = tracks_[place_[members[i]]];
    double square = 0;
    for (int d = 0; d < 3; ++d) {
      x[i][d] = track.x[d] + track.v[d] * (now - begin_);
      square += (track.v[d] - last.v[d]) * (track.v[d] - last.v[d]);
    }
    const int of = static_cast<int>(i) < side ? 0 : 1;
    speed[of] = std::max(speed[of], std::sqrt(square));
    room[of] = std::max(room[of], track.room);
  }
  const double left =
      closest(stencil.kind, std::span(x).first(members.size())).distance - room[0] - room[1] - reach;
  return left > 0 ? now + left / (speed[0] + speed[1]) : -std::numeric_limits<double>::infinity();
}

/// The stencils that may come within reach up to that time; false where there are more than `most`.
bool Candidates::find(double horizon, std::size_t most) {
  std::vector<Box> boxes(tracks_.size());
  for (std::size_t p = 0; p < tracks_.size(); ++p) {
    const Track& track = tracks_[p];
    double low[3] = {}, high[3] = {};
    for (int d = 0; d < dimension_; ++d) {
      const double end = track.x[d] + (track.v[d] - drift_[d]) * horizon;
      const double about = track.room + reach_ / 2;
      low[d] = std::min(track.x[d], end) - about;
      high[d] = std::max(track.x[d], end) + about;
    }
    boxes[p] = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  }
  const auto of_vertex = [&](int i) { return boxes[place_[i]]; };
  const auto of_edge = [&](const std::array<int, 2>& e) { return hull(of_vertex(e[0]), of_vertex(e[1])); };
  const auto of_triangle = [&](const std::array<int, 3>& t) {
    return hull(hull(of_vertex(t[0]), of_vertex(t[1])), of_vertex(t[2]));
  };
  const auto tree_of = [](const auto& features, const auto& box) {
    std::vector<Boxed> all;
    all.reserve(features.size());
    for (std::size_t f = 0; f < features.size(); ++f) all.emplace_back(box(features[f]), static_cast<int>(f));
    return Tree(all);
  };

  list_.clear();
  const auto add = [&](const Stencil& stencil) {
    const auto members = stencil.particles();
    if (std::ranges::all_of(members, [&](int i) { return fixed_[i]; })) return;
    if (!body_.empty() && body_[members.front()] == body_[members.back()]) return;
    list_.push_back(stencil);
  };
  const auto each_near = [&](const Tree& tree, const Box& box, const auto& use) {
    for (auto found = tree.qbegin(bg::index::intersects(box)); found != tree.qend(); ++found)
      use(found->second);
  };

  const auto points_among = [&](const std::vector<int>& points) {
    const Tree tree = tree_of(points, of_vertex);
    for (std::size_t a = 0; a < points.size() && list_.size() <= most; ++a)
      each_near(tree, of_vertex(points[a]), [&](int b) {
        if (static_cast<std::size_t>(b) > a)
          add({StencilKind::vertex_vertex, {points[a], points[b], -1, -1}});
      });
  };
  const auto points_and_edges = [&](const std::vector<int>& points,
                                    const std::vector<std::array<int, 2>>& edges) {
    if (points.empty() || edges.empty()) return;
    const Tree tree = tree_of(edges, of_edge);
    for (std::size_t p = 0; p < points.size() && list_.size() <= most; ++p)
      each_near(tree, of_vertex(points[p]), [&](int e) {
        if (!contains(edges[e], points[p]))
          add({StencilKind::vertex_edge, {points[p], edges[e][0], edges[e][1], -1}});
      });
  };
  if (dimension_ == 1) {
    points_among(surface_.vertices());
  } else if (dimension_ == 2) {
    points_among(surface_.loose_vertices());
    points_and_edges(surface_.vertices(), surface_.edges());
  } else {
    points_among(surface_.loose_vertices());
    points_and_edges(surface_.loose_vertices(), surface_.loose_edges());
    const auto& triangles = surface_.triangles();
    if (!triangles.empty()) {
      const Tree tree = tree_of(triangles, of_triangle);
      const auto& vertices = surface_.vertices();
      for (std::size_t p = 0; p < vertices.size() && list_.size() <= most; ++p)
        each_near(tree, of_vertex(vertices[p]), [&](int t) {
          const auto& [a, b, c] = triangles[t];
          if (!contains(triangles[t], vertices[p])) add({StencilKind::vertex_face, {vertices[p], a, b, c}});
        });
    }
    const auto& edges = surface_.edges();
    if (!edges.empty()) {
      const Tree tree = tree_of(edges, of_edge);
      for (std::size_t e = 0; e < edges.size() && list_.size() <= most; ++e)
        each_near(tree, of_edge(edges[e]), [&](int f) {
          if (static_cast<std::size_t>(f) <= e || contains(edges[f], edges[e][0]) ||
              contains(edges[f], edges[e][1]))
            return;
          add({StencilKind::edge_edge, {edges[e][0], edges[e][1], edges[f][0], edges[f][1]}});
        });
    }
  }
  if (list_.size() > most) return false;
  std::ranges::sort(list_);
  return true;
}

}  // namespace jetlag
