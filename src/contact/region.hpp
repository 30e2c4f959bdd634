// SPDX-License-Identifier: MIT
#pragma once
// A region of a stencil: the features that carry its distance. What must hold for it to be the right one, as series.
//
// The distance of two segments, or of a point and a triangle, is the minimum of a convex function. With the points p_A and p_B
// in the span of the features, r = p_A - p_B their way, b_i the weights of the vertices, it is theirs if and only if
//
//     |b_i| >= 0 as weights, those of A positive, those of B negative,
//     (x_k - p_A) . r >= 0  for the other vertices k of A,      (p_B - x_k) . r >= 0  for those of B.

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "jetlag/contact/closest.hpp"
#include "jetlag/forces/solids/simplex.hpp"
#include "jetlag/series/eigen.hpp"

namespace jetlag {

/// Which vertices carry the distance: bit i for vertex i of the stencil.
using Support = unsigned;

inline Support support_of(const Closest& closest) {
  Support support = 0;
  for (const int i : closest.vertices)
    if (i >= 0) support |= 1U << i;
  return support;
}

template <class T>
using Vector3 = Vector<T, 3>;

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// The vertices of a support on either side.
struct Sides {
  std::array<int, 3> a{}, b{};
  int count_a = 0, count_b = 0;
};
inline Sides sides_of(StencilKind kind, Support support) {
  Sides sides;
  for (int i = 0; i < vertices_of(kind); ++i) {
    if (!(support >> i & 1U)) continue;
    if (i < first_side(kind))
      sides.a[sides.count_a++] = i;
    else
      sides.b[sides.count_b++] = i;
  }
  return sides;
}

/// The weights b_i of d n = sum_i b_i x_i for the lines and planes of a support; 0 for other vertices.
template <class T>
std::array<T, 4> weights_of(const Sides& sides, std::span<const Vector3<T>> x) {
  std::array<T, 4> b{T(0.0), T(0.0), T(0.0), T(0.0)};
  const auto on_line = [&](int p, int from, int to) {  // weight of `to` in the foot of p
    const Vector3<T> e = x[to] - x[from], s = x[p] - x[from];
    return T(dot(s, e) / dot(e, e));
  };
  if (sides.count_a == 1 && sides.count_b == 1) {
    b[sides.a[0]] = T(1.0);
    b[sides.b[0]] = T(-1.0);
  } else if (sides.count_a == 1 && sides.count_b == 2) {
    const T t = on_line(sides.a[0], sides.b[0], sides.b[1]);
    b[sides.a[0]] = T(1.0);
    b[sides.b[0]] = t - T(1.0);
    b[sides.b[1]] = -t;
  } else if (sides.count_a == 2 && sides.count_b == 1) {
    const T t = on_line(sides.b[0], sides.a[0], sides.a[1]);
    b[sides.b[0]] = T(-1.0);
    b[sides.a[0]] = T(1.0) - t;
    b[sides.a[1]] = t;
  } else if (sides.count_b == 3) {
    const Vector3<T> s = x[sides.a[0]] - x[sides.b[0]], e1 = x[sides.b[1]] - x[sides.b[0]],
                     e2 = x[sides.b[2]] - x[sides.b[0]], n = detail::cross(e1, e2);
    const T area = dot(n, n), beta = dot(detail::cross(s, e2), n) / area,
            gamma = dot(detail::cross(e1, s), n) / area;
    b[sides.a[0]] = T(1.0);
    b[sides.b[0]] = beta + gamma - T(1.0);
    b[sides.b[1]] = -beta;
    b[sides.b[2]] = -gamma;
  } else {
    const Vector3<T> s = x[sides.a[0]] - x[sides.b[0]], e1 = x[sides.a[1]] - x[sides.a[0]],
                     e2 = x[sides.b[1]] - x[sides.b[0]], n = detail::cross(e1, e2);
    const T area = dot(n, n), sigma = -(dot(detail::cross(s, e2), n) / area),
            tau = -(dot(detail::cross(s, e1), n) / area);
    b[sides.a[0]] = T(1.0) - sigma;
    b[sides.a[1]] = sigma;
    b[sides.b[0]] = tau - T(1.0);
    b[sides.b[1]] = -tau;
  }
  return b;
}

/// A region along a motion, or at a moment.
template <class T>
struct Region {
  T square;                   // of the distance [m^2]
  std::vector<T> conditions;  // each is >= 0 where the region is the right one
};

/// band: how far beyond a condition a region still holds, a part of what the condition is of.
template <class T>
Region<T> region_of(StencilKind kind, Support support, std::span<const Vector3<T>> x, double band) {
  const Sides sides = sides_of(kind, support);
  const std::array<T, 4> b = weights_of<T>(sides, x);
  Vector3<T> on_a = Vector3<T>::Constant(T(0.0)), on_b = on_a;
  for (int i = 0; i < vertices_of(kind); ++i) {
    if (!(support >> i & 1U)) continue;
    if (i < first_side(kind))
      on_a += b[i] * x[i];
    else
      on_b -= b[i] * x[i];
  }
  const Vector3<T> r = on_a - on_b;
  Region<T> region{dot(r, r), {}};
  for (int i = 0; i < vertices_of(kind); ++i) {
    const bool is_a = i < first_side(kind);
    if (support >> i & 1U) {
      if ((is_a ? sides.count_a : sides.count_b) > 1)
        region.conditions.push_back((is_a ? b[i] : -b[i]) + T(band));
    } else {
      const Vector3<T> to = is_a ? Vector3<T>(x[i] - on_a) : Vector3<T>(on_b - x[i]);
      const auto square = [](const Vector3<T>& way) { return dot(way, way); };
      region.conditions.push_back(dot(to, r) + T(band) * (square(to) + square(r)));
    }
  }
  return region;
}

/// Whether a region is the right one at a place.
inline bool holds_at(StencilKind kind, Support support, std::span<const Vector3<double>> x, double band) {
  const auto region = region_of<double>(kind, support, x, band);
  return std::ranges::all_of(region.conditions, [](double c) { return c >= 0; });
}

/// The region at a place. Of edges that are nearly parallel closest() takes the middle of what lies beside each other, which is
/// no region: their lines may come near each other far away. There it is the nearest end of the one beside the other.
inline Support support_at(StencilKind kind, std::span<const Vector3<double>> x, const Closest& now,
                          double band) {
  constexpr Support all_four = 0b1111;
  const Support support = support_of(now);
  if (kind != StencilKind::edge_edge || support != all_four || holds_at(kind, support, x, band))
    return support;
  Support nearest = support;
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [p, a, b] : {std::array{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}}) {
    const std::array<Eigen::Vector3d, 3> of_end{x[p], x[a], x[b]};
    const Closest end = closest(StencilKind::vertex_edge, of_end);
    if (!(end.distance < distance)) continue;
    distance = end.distance;
    const std::array<int, 3> which{p, a, b};
    nearest = 0;
    for (const int i : end.vertices)
      if (i >= 0) nearest |= 1U << which[i];
  }
  return nearest;
}

}  // namespace jetlag
