// SPDX-License-Identifier: MIT
#include "jetlag/contact/approach.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/bernstein.hpp"

namespace jetlag {

namespace {

using Point = Eigen::Vector3d;

/// A row holds a coefficient or a control point of all vertices: x of four, y of four, z of four. Where there are fewer, the
/// last one stands for the others, which changes no smallest and no largest value.
constexpr std::size_t lanes = 4, components = 3, row = lanes * components;
constexpr int most_splits = 30;  // the smallest piece of the step is 2^-30 of it
constexpr double eps = std::numeric_limits<double>::epsilon();

/// The vertices at one time: how far the sides are apart, and the direction from B to A.
struct Gap {
  double distance;
  Point direction;  // not finite where the distance is 0
};

[[noreturn]] void refuse(std::span<const PathView> vertices, double h) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (int k = 0; k <= vertices[i].degree; ++k)
      for (int c = 0; c < vertices[i].dimension; ++c)
        if (!std::isfinite(vertices[i].c_0[k * vertices[i].stride + c]))
          throw std::invalid_argument("approach: coefficient " + std::to_string(k) + " of vertex " +
                                      std::to_string(i) + " of the stencil is not finite");
  throw std::invalid_argument("approach: the motion of the stencil overflows within h = " + shown(h) + " s");
}

}  // namespace

struct Approach::Search {
  StencilKind kind;
  std::size_t degree;
  double eta;         // widened
  double* projected;  // rows of four, on the directions at the beginning and at the end of a piece
  double* rows;       // of the piece on level 0; each level has degree + 1 rows
  int pieces = 1;

  std::size_t rows_of_level() const { return (degree + 1) * row; }
  double* on_begin() const { return projected; }
  double* on_end() const { return projected + (degree + 1) * lanes; }

  Gap gap(const double* points) const {
    std::array<Point, lanes> x;
    for (std::size_t i = 0; i < lanes; ++i) x[i] = {points[i], points[lanes + i], points[2 * lanes + i]};
    const Closest near = closest(kind, std::span(x).first(vertices_of(kind)));
    return {near.distance, near.way / near.distance};
  }

  /// The gap at the end of a piece in powers.
  Gap gap_at_end() const {
    double sum[row];
    std::copy_n(rows + degree * row, row, sum);
    for (std::size_t k = degree; k-- > 0;)
      for (std::size_t j = 0; j < row; ++j) sum[j] += rows[k * row + j];
    return gap(sum);
  }

  /// q_i = v.x_i for all rows.
  void project(const double* x, const Point& v, double* q) const {
    for (std::size_t k = 0; k <= degree; ++k, x += row, q += lanes)
      for (std::size_t i = 0; i < lanes; ++i)
        q[i] = v[0] * x[i] + v[1] * x[lanes + i] + v[2] * x[2 * lanes + i];
  }

  bool is_apart(const double* q) const {
    const bool two_and_two = kind == StencilKind::edge_edge;
    const double a = two_and_two ? std::min(q[0], q[1]) : q[0];
    const double b = std::max(two_and_two ? q[2] : std::max(q[1], q[2]), q[3]);
    return a - b > eta;
  }

  bool are_apart(const double* q) const {
    for (std::size_t k = 0; k <= degree; ++k)
      if (!is_apart(q + k * lanes)) return false;
    return true;
  }

  /// The same for the direction that turns, v(u) = (1-u) v_0 + u v_1: of degree N+1, with the control points
  ///     q_k = (N+1-k)/(N+1) v_0.P_k + k/(N+1) v_1.P_{k-1}.   As |v(u)| <= 1, the sides are no nearer than they say.
  bool are_apart_turning() const {
    const double *begin = on_begin(), *end = on_end() - lanes;
    for (std::size_t k = 0; k <= degree + 1; ++k, begin += lanes, end += lanes) {
      const double part = static_cast<double>(k) / static_cast<double>(degree + 1);
      double q[lanes] = {};
      if (k <= degree)
        for (std::size_t i = 0; i < lanes; ++i) q[i] = (1 - part) * begin[i];
      if (k > 0)
        for (std::size_t i = 0; i < lanes; ++i) q[i] += part * end[i];
      if (!is_apart(q)) return false;
    }
    return true;
  }

  /// Of a piece given by its control points.
  bool is_proved(const double* points, const Gap& begin, const Gap& end) const {
    project(points, begin.direction, on_begin());
    if (are_apart(on_begin())) return true;
    if (end.distance <= eta) return false;
    project(points, end.direction, on_end());
    return are_apart(on_end()) || are_apart_turning();
  }

  std::optional<double> first(const Gap& begin);
  std::optional<double> first_of_halves(Gap begin, const Gap& end);
};

/// In parts of the step. Its whole is looked at in powers: four polynomials to transform for a direction instead of twelve.
std::optional<double> Approach::Search::first(const Gap& begin) {
  project(rows, begin.direction, on_begin());
  detail::to_bernstein<lanes>(on_begin(), degree);
  if (are_apart(on_begin())) return std::nullopt;
  const Gap end = gap_at_end();
  if (end.distance > eta) {
    project(rows, end.direction, on_end());
    detail::to_bernstein<lanes>(on_end(), degree);
    if (are_apart(on_end()) || are_apart_turning()) return std::nullopt;
  }
  detail::to_bernstein<row>(rows, degree);
  return first_of_halves(begin, end);
}

/// The piece on a level begins where all before it is proved; its second half waits on its level while the first one is
/// looked at on the next.
std::optional<double> Approach::Search::first_of_halves(Gap begin, const Gap& end) {
  struct Level {
    double high;
    Gap end;
    int splits;
  };
  std::array<Level, most_splits + 1> levels;
  levels[0] = {1, end, 0};
  double low = 0;
  for (std::size_t at = 0;;) {
    Level& piece = levels[at];
    double* const points = rows + at * rows_of_level();
    if (begin.distance <= eta) return low;
    if (piece.splits > 0) ++pieces;
    if (piece.splits > 0 && is_proved(points, begin, piece.end)) {
      if (at == 0) return std::nullopt;
      begin = piece.end;
      low = piece.high;
      --at;
      continue;
    }
    if (piece.splits == most_splits) return low > 0 ? low : piece.high;
    ++piece.splits;
    const double middle = 0.5 * (low + piece.high);
    detail::split_bernstein<row>(points, points + rows_of_level(), degree, 0.5);
    levels[++at] = {middle, gap(points), piece.splits};
  }
}

std::optional<double> Approach::first(StencilKind kind, std::span<const PathView> vertices, double h,
                                      double eta) {
  if (!(h > 0) || !std::isfinite(h))
    throw std::invalid_argument("approach: h must be > 0 and finite, got " + shown(h) + " s");
  if (!(eta >= 0) || !std::isfinite(eta))
    throw std::invalid_argument("approach: eta must be >= 0 and finite, got " + shown(eta) + " m");
  assert(std::ssize(vertices) == vertices_of(kind));

  int degree = 0;
  for (const PathView& path : vertices) degree = std::max(degree, path.degree);
  Search search{kind, static_cast<std::size_t>(degree), eta, nullptr, nullptr};
  const std::size_t needed = (most_splits + 2) * search.rows_of_level();
  if (rows_.size() < needed) rows_.resize(needed);
  search.projected = rows_.data();
  search.rows = search.projected + search.rows_of_level();
  std::fill_n(search.rows, search.rows_of_level(), 0.0);

  // In parts of the step, about the first vertex: its place costs no digits.
  Point origin = Point::Zero();
  for (int c = 0; c < vertices[0].dimension; ++c) origin[c] = vertices[0].c_0[c];
  double far = 0,
         size = 0;  // of positions, and of the stencil and its motion; sums, which keep what is not finite
  for (std::size_t i = 0; i < lanes; ++i) {
    const PathView& path = vertices[std::min(i, vertices.size() - 1)];
    const double ratio = h / path.unit;
    double power = 1, reach = 0;
    for (int k = 0; k <= path.degree; ++k) {
      for (int c = 0; c < path.dimension; ++c) {
        const double x = path.c_0[k * path.stride + c] * (path.weights ? path.weights[k] : 1.0);
        if (k == 0) far = std::max(far, std::abs(x));
        const double scaled = k == 0 ? x - origin[c] : x * power;
        search.rows[static_cast<std::size_t>(k) * row + static_cast<std::size_t>(c) * lanes + i] = scaled;
        reach += std::abs(scaled);
      }
      power *= ratio;
    }
    if (!std::isfinite(reach)) refuse(vertices, h);
    size = std::max(size, reach);
  }
  search.eta += 64 * eps * (far + size) + 32 * (degree + 2) * eps * size;

  const Gap begin = search.gap(search.rows);
  pieces_ = 1;
  if (begin.distance <= search.eta) return 0;
  const auto part = search.first(begin);
  pieces_ = search.pieces;
  return part ? std::optional(*part * h) : std::nullopt;
}

}  // namespace jetlag
