// SPDX-License-Identifier: MIT
#pragma once
// Laws of three and four participants, and of external ones, beside those of the library.

#include <array>
#include <utility>

#include "jetlag/forces/force.hpp"
#include "jetlag/forces/molecular/angle.hpp"

namespace jetlag::testing {

/// The library's Angle, but at the last participant, with forces written by hand.
struct AngleByHand {
  static constexpr const char* name = "angle_by_hand";
  static constexpr int participants = 3;
  static constexpr std::array parameters = Angle::parameters;
  static constexpr std::array dimensions = Angle::dimensions;

  template <class T, int D>
  static std::array<Vector<T, D>, 2> forces(const Participants<T, D, 3>& p, const T& k, const T& cosine) {
    const Vector<T, D> a = p.position[0] - p.position[2], b = p.position[1] - p.position[2];
    const T aa = a.squaredNorm(), bb = b.squaredNorm(), both = a.norm() * b.norm(), cos = T(a.dot(b)) / both;
    const T pull = T(-k) * (cos - cosine);
    return {Vector<T, D>(T(pull / both) * b - T(pull * cos / aa) * a),
            Vector<T, D>(T(pull / both) * a - T(pull * cos / bb) * b)};
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 3>& p, const T& k, const T& cosine) {
    Participants<T, D, 3> bonds = p;
    std::swap(bonds.position[1], bonds.position[2]);
    return Angle::energy(bonds, k, cosine);
  }
};

/// E = k/2 |x_0 + x_1 - 2 x_2|^2: linear. The tangents of single participants are k, k and 4 k.
struct Bend {
  static constexpr const char* name = "bend";
  static constexpr int participants = 3;
  static constexpr std::array parameters{"stiffness"};

  template <class T, int D>
  static std::array<Vector<T, D>, 2> forces(const Participants<T, D, 3>& p, const T& k) {
    const Vector<T, D> f = T(-k) * bow(p);
    return {f, f};
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 3>& p, const T& k) {
    return T(0.5) * k * bow(p).squaredNorm();
  }
  static double stiffness(double k) { return 4 * k; }

 private:
  template <class T, int D>
  static Vector<T, D> bow(const Participants<T, D, 3>& p) {
    return (p.position[0] - p.position[2]) + (p.position[1] - p.position[2]);
  }
};

/// E = k/2 (V - V_0)^2, V = d_0 . (d_1 x d_2) / 6 the volume, d from the last participant to the others.
struct Tetrahedron {
  static constexpr const char* name = "tetrahedron";
  static constexpr int participants = 4;
  static constexpr std::array parameters{"stiffness", "volume"};
  static constexpr std::array dimensions{3};

  template <class T, int D>
  static std::array<Vector<T, D>, 3> forces(const Participants<T, D, 4>& p, const T& k, const T& volume) {
    const auto [d, c] = edges(p);
    const T pull = T(-k) * (T(T(1.0 / 6) * d[0].dot(c[0])) - volume) * T(1.0 / 6);
    return {Vector<T, D>(pull * c[0]), Vector<T, D>(pull * c[1]), Vector<T, D>(pull * c[2])};
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 4>& p, const T& k, const T& volume) {
    const auto [d, c] = edges(p);
    const T off = T(T(1.0 / 6) * d[0].dot(c[0])) - volume;
    return T(0.5) * k * off * off;
  }

 private:
  template <class T, int D>
  struct Edges {
    std::array<Vector<T, D>, 3> d, c;  // c_i = d_{i+1} x d_{i+2}
  };
  template <class T, int D>
  static Edges<T, D> edges(const Participants<T, D, 4>& p) {
    Edges<T, D> e;
    for (int i = 0; i < 3; ++i) e.d[i] = p.position[i] - p.position[3];
    for (int i = 0; i < 3; ++i) {
      const Vector<T, D>&a = e.d[(i + 1) % 3], &b = e.d[(i + 2) % 3];
      e.c[i] << T(a[1] * b[2]) - T(a[2] * b[1]), T(a[2] * b[0]) - T(a[0] * b[2]),
          T(a[0] * b[1]) - T(a[1] * b[0]);
    }
    return e;
  }
};

/// External: F_0 = -k x_0, F_1 = -2 k x_1.
struct Anchors {
  static constexpr const char* name = "anchors";
  static constexpr int participants = 2;
  static constexpr bool external = true;
  static constexpr std::array parameters{"stiffness"};

  template <class T, int D>
  static std::array<Vector<T, D>, 2> forces(const Participants<T, D, 2>& p, const T& k) {
    return {Vector<T, D>(T(-k) * p.position[0]), Vector<T, D>(T(T(-2.0) * k) * p.position[1])};
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& k) {
    return k * (T(0.5) * p.position[0].squaredNorm() + p.position[1].squaredNorm());
  }
  static double stiffness(double k) { return 2 * k; }
};

}  // namespace jetlag::testing
