// SPDX-License-Identifier: MIT
#pragma once
// Two triangles at an edge, and the angle between them.

#include <array>
#include <cmath>

#include "jetlag/forces/solids/simplex.hpp"

namespace jetlag::detail {

/// The triangles (x_0, x_1, x_2) and (x_1, x_0, x_3) at the edge x_0 x_1, by differences from x_0:
///     e = x_1 - x_0,   a = x_2 - x_0,   b = x_3 - x_0,   n_2 = e x a,   n_3 = b x e,
///     |n_2| |n_3| sin theta = (n_2 x n_3) . e / |e| = -|e| a . n_3,   |n_2| |n_3| cos theta = n_2 . n_3.
/// theta: 0 where both lie in a plane on two sides of the edge, +-pi where one lies on the other.
template <class T>
struct Fold {
  Vector<T, 3> e, a, b, n_2, n_3;
  T length, sine, cosine;  // |e| [m];  |n_2| |n_3| sin theta and cos theta [m^4]

  explicit Fold(const std::array<Vector<T, 3>, 4>& x)
      : e(x[1] - x[0]), a(x[2] - x[0]), b(x[3] - x[0]), n_2(cross<T>(e, a)), n_3(cross<T>(b, e)) {
    using std::sqrt;
    length = sqrt(T(e.squaredNorm()));
    sine = -(length * T(a.dot(n_3)));
    cosine = n_2.dot(n_3);
  }

  /// theta, in [-pi, pi]; not a number where a triangle has no area.
  T angle() const {
    using std::atan2;
    return atan2(sine, cosine);
  }
};

/// A fold at rest.
template <class T>
struct FoldAtRest {
  T squared_length;  // |e|^2 [m^2]
  T area;            // of both triangles [m^2]
  T angle;           // theta
};

/// Throws std::invalid_argument where a triangle is flat (rest_shape), and for a rigidity [N m] below zero.
template <class T>
FoldAtRest<T> fold_at_rest(const std::array<Vector<T, 3>, 4>& x, const T& rigidity) {
  if (!(rigidity >= T(0)))
    throw std::invalid_argument("rigidity must be >= 0, got " + text_of(rigidity) + " N m");
  const Fold<T> fold(x);
  return {fold.e.squaredNorm(),
          rest_shape<T, 3, 2>({x[0], x[1], x[2]}).volume() + rest_shape<T, 3, 2>({x[1], x[0], x[3]}).volume(),
          fold.angle()};
}

}  // namespace jetlag::detail
