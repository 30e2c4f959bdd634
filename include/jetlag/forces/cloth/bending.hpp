// SPDX-License-Identifier: MIT
#pragma once
// Bending of sheets that are flat at rest and hardly stretch: linear.

#include <algorithm>
#include <array>
#include <cmath>

#include "jetlag/forces/cloth/fold.hpp"

namespace jetlag {

/// E = D/2 |u|^2 / (A_0 + A_1),   u = sum_i k_i x_i,   f_i = -D k_i u / (A_0 + A_1),
/// with the areas A of the triangles (x_0, x_1, x_2) and (x_1, x_0, x_3) at an edge x_0 x_1 at rest, and of its edges
/// e_0 = x_0 x_1, e_1 = x_0 x_2, e_2 = x_0 x_3, e_3 = x_1 x_2, e_4 = x_1 x_3 by the cotangents c_jk of the angle between two
/// (c_03 and c_04 with -e_0):
///     k = (c_03 + c_04,  c_01 + c_02,  -c_01 - c_03,  -c_02 - c_04),   sum k = 0.
/// Participants: the two ends of the edge, then the vertices opposite to it, of each side one.
/// rigidity D [N m], >= 0: of a plate of thickness t it is E t^3 / (12 (1 - nu^2)). Parameters: k_i sqrt(D / (A_0 + A_1)).
/// With equilateral triangles the energy of a cylinder of curvature kappa is that of the plate, D/2 kappa^2 times its area;
/// with right-angled ones it is up to 3 times that, by the direction, and does not converge: see SheetPattern
/// (scenes/mesh.hpp).
/// Source: M. Bergou et al., A quadratic bending model for inextensible surfaces, Eurographics SGP 2006; there the weight is
/// 3 / (A_0 + A_1), and D a third of the rigidity.
/// Range: everywhere. Exact for motions of rigid bodies; lengths are taken to be those at rest.
/// Conserves: momentum, angular momentum, energy.
struct Bending {
  static constexpr const char* name = "bending";
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array material{"rigidity"};
  static constexpr std::array parameters{"weight_0", "weight_1", "weight_2"};  // [sqrt(N/m)]

  static constexpr double flat = 1e-6;  // [rad]

  /// Throws std::invalid_argument for a rest shape that is not flat.
  template <class T>
  static std::array<T, 3> at_rest(const std::array<Vector<T, 3>, 4>& x, const T& rigidity) {
    using std::sqrt;
    const auto rest = detail::fold_at_rest<T>(x, rigidity);
    if (rest.angle > T(flat) || rest.angle < T(-flat))
      throw std::invalid_argument("not flat at rest: its triangles are folded by " +
                                  detail::text_of(rest.angle) + "; at most 1e-6, else take hinge");
    const auto cotangent = [](const Vector<T, 3>& u, const Vector<T, 3>& v) {
      return T(u.dot(v) / sqrt(detail::cross<T>(u, v).squaredNorm()));
    };
    const Vector<T, 3> e = x[1] - x[0];
    const T c_01 = cotangent(e, x[2] - x[0]), c_02 = cotangent(e, x[3] - x[0]),
            c_03 = cotangent(-e, x[2] - x[1]), c_04 = cotangent(-e, x[3] - x[1]);
    const T root = sqrt(T(rigidity / rest.area));
    return {root * (c_03 + c_04), root * (c_01 + c_02), -(root * (c_01 + c_03))};
  }

  template <class T>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 4>& p, const T& w_0, const T& w_1,
                                            const T& w_2) {
    const Vector<T, 3> u = bow(p, w_0, w_1, w_2);
    return {Vector<T, 3>(T(-w_0) * u), Vector<T, 3>(T(-w_1) * u), Vector<T, 3>(T(-w_2) * u)};
  }
  template <class T>
  static T energy(const Participants<T, 3, 4>& p, const T& w_0, const T& w_1, const T& w_2) {
    return T(0.5) * T(bow(p, w_0, w_1, w_2).squaredNorm());
  }

  static double stiffness(double w_0, double w_1, double w_2) {
    const double w_3 = w_0 + w_1 + w_2;
    return std::max({w_0 * w_0, w_1 * w_1, w_2 * w_2, w_3 * w_3});
  }

 private:
  template <class T>
  static Vector<T, 3> bow(const Participants<T, 3, 4>& p, const T& w_0, const T& w_1, const T& w_2) {
    return w_0 * (p.position[0] - p.position[3]) + w_1 * (p.position[1] - p.position[3]) +
           w_2 * (p.position[2] - p.position[3]);
  }
};

extern template RecordedLaw record_law<Bending>(int);  // recorded in src/forces

}  // namespace jetlag
