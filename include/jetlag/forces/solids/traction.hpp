// SPDX-License-Identifier: MIT
#pragma once
// Dead loads on the faces of solids.

#include <cmath>
#include <stdexcept>

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// A load on a face that does not turn with it:  f_i = A t / 3, i = 0, 1, 2;   E = -sum_i f_i . x_i.
/// traction t [Pa], A the area of the face at rest; the parameters are the force on each of its vertices [N].
/// Conserves: energy.
struct Traction {
  static constexpr const char* name = "traction";
  static constexpr int participants = 3;
  static constexpr bool external = true;
  static constexpr std::array dimensions{3};
  static constexpr std::array material{"traction_x", "traction_y", "traction_z"};
  static constexpr std::array parameters{"force_x", "force_y", "force_z"};

  template <class T>
  static std::array<T, 3> at_rest(const std::array<Vector<T, 3>, 3>& x, const T& t_x, const T& t_y,
                                  const T& t_z) {
    using std::sqrt;
    const Vector<T, 3> a = x[0] - x[2], b = x[1] - x[2];
    const T edge = a.squaredNorm() > b.squaredNorm() ? a.squaredNorm() : b.squaredNorm();
    T squared(0);
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      const T component = a[next] * b[last] - a[last] * b[next];
      squared += component * component;
    }
    const T twice_area = sqrt(squared);
    if (twice_area <= T(1e-12) * edge) throw std::invalid_argument("flat at rest; its area must be > 0");
    return {t_x * twice_area / T(6), t_y * twice_area / T(6), t_z * twice_area / T(6)};
  }

  template <class T>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 3>&, const T& x, const T& y,
                                            const T& z) {
    const Vector<T, 3> f(x, y, z);
    return {f, f, f};
  }

  template <class T>
  static T energy(const Participants<T, 3, 3>& p, const T& x, const T& y, const T& z) {
    return -T(Vector<T, 3>(x, y, z).dot(p.position[0] + p.position[1] + p.position[2]));
  }
};

extern template RecordedLaw record_law<Traction>(int);  // recorded in src/forces

}  // namespace jetlag
