// SPDX-License-Identifier: MIT
#pragma once
// Bending of sheets of any rest shape, by the angles at their edges.

#include <algorithm>
#include <array>
#include <cmath>

#include "jetlag/forces/cloth/fold.hpp"

namespace jetlag {

/// E = k/2 (theta - theta_0)^2,   k = D |e|^2 / (A_0 + A_1),
/// of the angle theta between the triangles (x_0, x_1, x_2) and (x_1, x_0, x_3) at an edge e = x_0 x_1, with the letters of
/// detail::Fold; |e| and the areas A at rest. With m = k (theta - theta_0), u = m |e| n_2 / |n_2|^2, v = m |e| n_3 / |n_3|^2:
///     f_2 = u,   f_3 = v,   f_1 = -(a.e u + b.e v) / e.e,   f_0 = -(u + v) - f_1.
/// Participants: the two ends of the edge, then the vertices opposite to it, of each side one.
/// rigidity D [N m], >= 0, as of Bending, which does the same for flat sheets at a third to a fifth of the cost. angle_share
/// s [1]: theta_0 is s times the angle of the rest shape: a sheet stays as it is (1) or wants to be flat (0).
/// Source: E. Grinspun, A. Hirani, M. Desbrun, P. Schroeder, Discrete shells, Eurographics SCA 2003; the gradient of theta is
/// that of a lever.
/// Range: triangles with an area, else the force is not finite; |theta| < pi. In a full fold, where one triangle comes to lie
/// on the other, theta jumps from pi to -pi, a kink at which steps end, and the energy by 2 pi k theta_0. What goes through it
/// has gone through itself.
/// Conserves: momentum, angular momentum, and short of a full fold energy.
struct Hinge {
  static constexpr const char* name = "hinge";
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array material{"rigidity", "angle_share"};
  static constexpr std::array parameters{"stiffness", "rest_angle"};  // [N m], [rad]

  /// Throws std::invalid_argument for a rest shape in full fold, within 1e-6.
  template <class T>
  static std::array<T, 2> at_rest(const std::array<Vector<T, 3>, 4>& x, const T& rigidity,
                                  const T& angle_share) {
    const auto rest = detail::fold_at_rest<T>(x, rigidity);
    if (rest.angle > T(3.1415916) || rest.angle < T(-3.1415916))
      throw std::invalid_argument("in full fold at rest: one of its triangles lies on the other");
    return {rigidity * rest.squared_length / rest.area, angle_share * rest.angle};
  }

  template <class T>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 4>& p, const T& stiffness,
                                            const T& rest_angle) {
    const detail::Fold<T> fold(p.position);
    const auto& [e, a, b, n_2, n_3, length, sine, cosine] = fold;
    const T moment = stiffness * (fold.angle() - rest_angle) * length, ee = e.squaredNorm();
    const Vector<T, 3> u = T(moment / T(n_2.squaredNorm())) * n_2, v = T(moment / T(n_3.squaredNorm())) * n_3;
    const Vector<T, 3> lever = T(T(a.dot(e)) / ee) * u + T(T(b.dot(e)) / ee) * v;
    return {Vector<T, 3>(lever - u - v), Vector<T, 3>(-lever), u};
  }
  template <class T>
  static T energy(const Participants<T, 3, 4>& p, const T& stiffness, const T& rest_angle) {
    const T off = detail::Fold<T>(p.position).angle() - rest_angle;
    return T(0.5) * stiffness * off * off;
  }

  /// r/3 (1 + cos theta, sin theta), r the smaller radius of the circles in the triangles: zero in a full fold. A vertex that
  /// moves by w changes r by w at most, and theta by w/r.
  static Vector<double, 2> kink(const Positions<3, 4>& x, double, double) {
    const detail::Fold<double> fold(x);
    const double size = std::hypot(fold.sine, fold.cosine);
    if (!(size > 0)) return {0, 0};
    const auto radius = [&](const Vector<double, 3>& normal, const Vector<double, 3>& side) {
      return normal.norm() / (fold.length + side.norm() + (side - fold.e).norm());
    };
    const double r = std::min(radius(fold.n_2, fold.a), radius(fold.n_3, fold.b));
    return r / 3 * Vector<double, 2>(1 + fold.cosine / size, fold.sine / size);
  }
};

extern template RecordedLaw record_law<Hinge>(int);  // recorded in src/forces

}  // namespace jetlag
