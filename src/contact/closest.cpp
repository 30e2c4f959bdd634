// SPDX-License-Identifier: MIT
#include "jetlag/contact/closest.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

namespace jetlag {

namespace {

using Point = Eigen::Vector3d;
using Points = std::span<const Point>;

/// A part of 1 as a multiple of 2^-52, so that 1 - part and the sums of such parts are exact.
double rounded(double part) { return (part + 1) - 1; }

/// The way is a sum of differences: positions far from the origin cost no digits.
Closest between(Points x, int p, int q) {
  Closest result{{}, x[p] - x[q], 0, StencilKind::vertex_vertex, {p, q, -1, -1}};
  result.b[p] = 1;
  result.b[q] = -1;
  result.distance = result.way.norm();
  return result;
}

/// b = (1; -(1-t), -t),  t = (p-a).e / |e|^2,  e = b - a.   on_p: 1 where p is of side A, else -1.
Closest vertex_edge(Points x, int p, int a, int b, double on_p = 1) {
  const auto end = [&](int q) { return on_p > 0 ? between(x, p, q) : between(x, q, p); };
  const Point e = x[b] - x[a], r = x[p] - x[a];
  const double along = r.dot(e), square = e.squaredNorm();
  if (!(along > 0)) return end(a);
  if (!(along < square)) return end(b);
  const double t = rounded(along / square);
  Closest result{{}, on_p * (r - t * e), 0, StencilKind::vertex_edge, {p, a, b, -1}};
  result.b[p] = on_p;
  result.b[a] = -on_p * (1 - t);
  result.b[b] = -on_p * t;
  result.distance = result.way.norm();
  return result;
}

Closest nearest_edge(Points x) {
  Closest result = vertex_edge(x, 0, 1, 2);
  for (const Closest& other : {vertex_edge(x, 0, 2, 3), vertex_edge(x, 0, 3, 1)})
    if (other.distance < result.distance) result = other;
  return result;
}

/// With n = (b-a) x (c-a) the barycentric coordinates of p, times |n|^2, are
///     A = n.((p-b) x (p-c)),   B = n.((p-c) x (p-a)),   C = n.((p-a) x (p-b)),   A + B + C = |n|^2;
/// p is outside of an edge where the one of the opposite vertex is not positive. Inside, what they leave of the way in the
/// plane shows how far rounding, over the angle of a thin face, has led astray. Where that angle is rounding itself, the
/// point found may be any one of the face: then an edge may be as near.
Closest vertex_face(Points x) {
  constexpr double thin = 1e-12;
  const Point ab = x[2] - x[1], ac = x[3] - x[1], bc = x[3] - x[2];
  const Point ap = x[0] - x[1], bp = x[0] - x[2], cp = x[0] - x[3];
  const double ab_a = ab.dot(ap), ac_a = ac.dot(ap);
  if (ab_a <= 0 && ac_a <= 0) return between(x, 0, 1);
  const double ab_b = ab.dot(bp), bc_b = bc.dot(bp);
  if (ab_b >= 0 && bc_b <= 0) return between(x, 0, 2);
  const double ac_c = ac.dot(cp), bc_c = bc.dot(cp);
  if (ac_c >= 0 && bc_c >= 0) return between(x, 0, 3);

  const Point n = ab.cross(ac);
  const double nn = n.squaredNorm();
  const bool is_thin = !(nn > thin * ab.squaredNorm() * ac.squaredNorm());
  const double inside_c = n.dot(ap.cross(bp));
  if (!is_thin && inside_c <= 0 && ab_a >= 0 && ab_b <= 0) return vertex_edge(x, 0, 1, 2);
  const double inside_b = n.dot(cp.cross(ap));
  if (!is_thin && inside_b <= 0 && ac_a >= 0 && ac_c <= 0) return vertex_edge(x, 0, 1, 3);
  if (!is_thin && n.dot(bp.cross(cp)) <= 0 && bc_b >= 0 && bc_c <= 0) return vertex_edge(x, 0, 2, 3);

  const double near_v = inside_b / nn, near_w = inside_c / nn;
  const Point left = ap - near_v * ab - near_w * ac;
  const double v = rounded(near_v + n.dot(left.cross(ac)) / nn);
  const double w = rounded(near_w + n.dot(ab.cross(left)) / nn);
  if (!(v >= 0 && w >= 0 && v + w <= 1)) return nearest_edge(x);
  const Point way = ap - v * ab - w * ac;
  const Closest inside{{1, -(1 - v - w), -v, -w}, way, way.norm(), StencilKind::vertex_face, {0, 1, 2, 3}};
  if (!is_thin) return inside;
  const Closest edge = nearest_edge(x);
  return edge.distance <= inside.distance ? edge : inside;
}

/// b = (1-s, s; -(1-t), -t), both inside.
Closest inside_edges(Points x, double s, double t) {
  s = rounded(s);
  t = rounded(t);
  const Point way = (x[0] - x[2]) + s * (x[1] - x[0]) - t * (x[3] - x[2]);
  return {{1 - s, s, -(1 - t), -t}, way, way.norm(), StencilKind::edge_edge, {0, 1, 2, 3}};
}

/// The middle of the interval of the first edge beside which the second one lies, and the point beside it. Where there is
/// none, it is the middle of what lies between them, and the ends next to it are the closest points.
Closest parallel_edges(Points x) {
  const Point p = x[1] - x[0], q = x[3] - x[2], r = x[2] - x[0];
  const double pp = p.squaredNorm(), qq = q.squaredNorm();
  if (!(pp > 0)) return vertex_edge(x, 0, 2, 3);
  if (!(qq > 0)) return vertex_edge(x, 2, 0, 1, -1);
  const double first = p.dot(r) / pp, last = first + p.dot(q) / pp;  // of the second edge, in s
  const double low = std::max(0.0, std::min(first, last)), high = std::min(1.0, std::max(first, last));
  const double s = std::clamp(0.5 * (low + high), 0.0, 1.0);
  const double t = (s * p - r).dot(q) / qq;
  return 0 < t && t < 1 ? inside_edges(x, s, t) : vertex_edge(x, t <= 0 ? 2 : 3, 0, 1, -1);
}

/// The closest point of the line of the first edge to that of the second, r = q_0 - p_0, n = p x q:  s = n.(r x q) / |n|^2;
/// then the closest one of the second edge to it, and where that is an end, the closest one of the first edge to the end.
Closest edge_edge(Points x) {
  constexpr double parallel = 1e-12;
  const Point p = x[1] - x[0], q = x[3] - x[2], r = x[2] - x[0], n = p.cross(q);
  const double nn = n.squaredNorm(), pp = p.squaredNorm(), qq = q.squaredNorm();
  if (!(nn > parallel * pp * qq)) return parallel_edges(x);
  const double s = std::clamp(n.dot(r.cross(q)) / nn, 0.0, 1.0);
  const double t = (s * p - r).dot(q);  // times |q|^2
  if (t <= 0) return vertex_edge(x, 2, 0, 1, -1);
  if (t >= qq) return vertex_edge(x, 3, 0, 1, -1);
  if (s == 0) return vertex_edge(x, 0, 2, 3);
  if (s == 1) return vertex_edge(x, 1, 2, 3);
  return inside_edges(x, s, t / qq);
}

}  // namespace

Closest closest(StencilKind kind, std::span<const Eigen::Vector3d> x) {
  assert(std::ssize(x) == vertices_of(kind));
  switch (kind) {
    case StencilKind::vertex_vertex: return between(x, 0, 1);
    case StencilKind::vertex_edge: return vertex_edge(x, 0, 1, 2);
    case StencilKind::vertex_face: return vertex_face(x);
    case StencilKind::edge_edge: break;
  }
  return edge_edge(x);
}

}  // namespace jetlag
