// SPDX-License-Identifier: MIT
#pragma once
// Two features of surfaces that may touch, and the distance between them: vertices, the lines of edges, the plane of a face.

#include <array>

#include "jetlag/forces/solids/simplex.hpp"

namespace jetlag::detail {

// A stencil has u = d^2 of its distance d [m^2], and the forces  f d b_i n  on its participants but the last:  n is the unit
// vector from one feature to the other,  d n = sum_i b_i x_i,  sum_i b_i = 0, and grad_i u = 2 d b_i n. All is written in
// differences of positions, and without a root. Not defined where an edge has no length, or a face no area.

/// Vertices x_0 and x_1:  d n = x_0 - x_1.
struct VertexVertex {
  static constexpr int participants = 2;
  static constexpr std::array dimensions{1, 2, 3};
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  struct At {
    Vector<T, D> r;
    T u;

    explicit At(const std::array<Vector<T, D>, 2>& x) : r(x[0] - x[1]), u(r.squaredNorm()) {}
    std::array<Vector<T, D>, 1> forces(const T& f) const { return {Vector<T, D>(f * r)}; }
  };
};

/// A vertex x_0 and the line through x_1 and x_2:  d n = m - t e,   m = x_0 - x_2,   e = x_2 - x_1,   t = m.e / e.e;
/// b = (1, t, -1 - t).
struct VertexEdge {
  static constexpr int participants = 3;
  static constexpr std::array dimensions{2, 3};
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  struct At {
    T t;
    Vector<T, D> r;
    T u;

    explicit At(const std::array<Vector<T, D>, 3>& x) {
      const Vector<T, D> m = x[0] - x[2], e = x[2] - x[1];
      t = T(m.dot(e)) / T(e.squaredNorm());
      r = m - t * e;
      u = r.squaredNorm();
    }
    std::array<Vector<T, D>, 2> forces(const T& f) const {
      const Vector<T, D> force = f * r;
      return {force, Vector<T, D>(t * force)};
    }
  };
};

/// The height of m over the plane of a and b, by  n = a x b,  c = n.n,  h = m.n:   u = h^2 / c,   s = h/c. An energy V(u, c)
/// pulls at them with
///     -dV/dm = f s n,   -dV/da = b x w,   -dV/db = w x a,   w = f s m - (f s^2 + 2 dV/dc) n,   f = -2 dV/du.
template <class T>
struct Height {
  Vector<T, 3> m, a, b, n;
  T c, s, u;

  Height(const Vector<T, 3>& m, const Vector<T, 3>& a, const Vector<T, 3>& b)
      : m(m), a(a), b(b), n(cross<T>(a, b)), c(n.squaredNorm()) {
    const T h = m.dot(n);
    s = h / c;
    u = s * h;
  }
  /// Those at m, a and b. slope: 2 dV/dc.
  std::array<Vector<T, 3>, 3> forces(const T& f, const T& slope) const {
    const T push = f * s, turn = push * s + slope;
    Vector<T, 3> w;
    for (int axis = 0; axis < 3; ++axis) w[axis] = T(push * m[axis]) - T(turn * n[axis]);
    return {Vector<T, 3>(push * n), cross<T>(b, w), cross<T>(w, a)};
  }
};

/// A vertex x_0 and the plane through x_1, x_2 and x_3.
struct VertexFace {
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int>
  struct At {
    Height<T> height;
    T u;

    explicit At(const std::array<Vector<T, 3>, 4>& x)
        : height(x[0] - x[3], x[1] - x[3], x[2] - x[3]), u(height.u) {}
    std::array<Vector<T, 3>, 3> forces(const T& f) const { return height.forces(f, T(0.0)); }
  };
};

/// The lines through x_0 and x_1, and through x_2 and x_3. Not defined where they are parallel.
struct EdgeEdge {
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int>
  struct At {
    Height<T> height;
    T u;

    explicit At(const std::array<Vector<T, 3>, 4>& x)
        : height(x[0] - x[3], x[1] - x[0], x[2] - x[3]), u(height.u) {}
    std::array<Vector<T, 3>, 3> forces(const T& f, const T& slope = T(0.0)) const {
      const auto [of_m, of_a, of_b] = height.forces(f, slope);
      return {Vector<T, 3>(of_m - of_a), of_a, of_b};
    }
  };
};

/// The same, whose energies are multiplied by  M(c) = c/eps (2 - c/eps),  c = |(x_1 - x_0) x (x_2 - x_3)|^2.
struct MollifiedEdgeEdge : EdgeEdge {
  static constexpr std::array parameters{"parallel"};  // eps [m^4]

  template <class T, int D>
  struct At : EdgeEdge::At<T, D> {
    using EdgeEdge::At<T, D>::At;

    T factor(const T& parallel) const {
      const T ratio = this->height.c / parallel;
      return ratio * (T(2.0) - ratio);
    }
    /// Of the energy V M(c), where V(u) is `energy`.
    std::array<Vector<T, 3>, 3> forces(const T& f, const T& energy, const T& parallel) const {
      const T slope = T(4.0) / parallel - T(4.0) / (parallel * parallel) * this->height.c;  // 2 dM/dc
      return EdgeEdge::At<T, D>::forces(f * factor(parallel), energy * slope);
    }
  };
};

}  // namespace jetlag::detail
