// SPDX-License-Identifier: MIT
#pragma once
// Barriers in another way, and stencils whose features are as far apart as one likes.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "support/random.hpp"

namespace jetlag::testing::contact {

template <class L>
constexpr bool is_log = std::string_view(L::name).starts_with("log_");
template <class L>
constexpr bool is_mollified = std::string_view(L::name).find("mollified") != std::string_view::npos;
template <class L>
constexpr bool is_of_edges = std::string_view(L::name).ends_with("edge_edge");

/// f.operator()<a barrier, a dimension in which it is defined>(), for all.
template <class F>
void for_each_barrier(F f) {
  f.template operator()<BarrierVertexVertex, 1>();
  f.template operator()<BarrierVertexVertex, 2>();
  f.template operator()<BarrierVertexVertex, 3>();
  f.template operator()<BarrierVertexEdge, 2>();
  f.template operator()<BarrierVertexEdge, 3>();
  f.template operator()<BarrierVertexFace, 3>();
  f.template operator()<BarrierEdgeEdge, 3>();
  f.template operator()<BarrierMollifiedEdgeEdge, 3>();
}
template <class F>
void for_each_log_barrier(F f) {
  f.template operator()<LogBarrierVertexVertex, 1>();
  f.template operator()<LogBarrierVertexVertex, 2>();
  f.template operator()<LogBarrierVertexVertex, 3>();
  f.template operator()<LogBarrierVertexEdge, 2>();
  f.template operator()<LogBarrierVertexEdge, 3>();
  f.template operator()<LogBarrierVertexFace, 3>();
  f.template operator()<LogBarrierEdgeEdge, 3>();
  f.template operator()<LogBarrierMollifiedEdgeEdge, 3>();
}

/// The energy of a barrier as a law of its own, by determinants of Gram matrices and logarithms:
///     d^2 = det Gram(m, e_1, ..) / det Gram(e_1, ..),   m from one feature to the other, e along them;   w^-q = exp(-q log w).
template <class L>
struct ByGram {
  static constexpr const char* name = "by_gram";
  static constexpr int participants = L::participants;
  static constexpr std::array dimensions = L::dimensions;
  static constexpr std::array parameters = L::parameters;

  template <class T, int D, class... C>
    requires(sizeof...(C) == parameters.size())
  static T energy(const Participants<T, D, participants>& p, const C&... all) {
    using std::exp, std::log, std::sqrt;
    const std::array<T, sizeof...(C)> c{all...};
    const T k = c[0], thickness = c[1], gap = c[2];
    const auto [squared, parallel] = squared_distance(p.position);
    const T factor = is_mollified<L>
                         ? T(T(2.0) * parallel / c.back() - parallel * parallel / (c.back() * c.back()))
                         : T(1.0);
    if constexpr (is_log<L>) {
      const T y = (sqrt(squared) - gap) / thickness;
      return -k * thickness * thickness * (T(1.0) - y) * (T(1.0) - y) * log(y) * factor;
    } else {
      const T inner = gap * gap, outer = (gap + thickness) * (gap + thickness);
      const T w = (squared - inner) / (outer - inner), beyond = (outer - squared) / (outer - inner);
      return k / T(8.0) * (outer - inner) * beyond * beyond * beyond * exp(-c[3] * log(w)) * factor;
    }
  }

  /// d^2, and |e_1|^2 |e_2|^2 - (e_1.e_2)^2 of two edges or the sides of a face.
  template <class T, int D>
  static std::array<T, 2> squared_distance(const std::array<Vector<T, D>, participants>& x) {
    const Vector<T, D> m = x[0] - x[is_of_edges<L> ? 2 : 1];
    const T mm = m.squaredNorm();
    if constexpr (participants == 2) {
      return {mm, T(1.0)};
    } else if constexpr (participants == 3) {
      const Vector<T, D> e = x[2] - x[1];
      const T ee = e.squaredNorm(), me = m.dot(e);
      return {mm - me * me / ee, T(1.0)};
    } else {
      const Vector<T, D> a = x[is_of_edges<L> ? 1 : 2] - x[is_of_edges<L> ? 0 : 1],
                         b = x[3] - x[is_of_edges<L> ? 2 : 1];
      const T aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b), ma = m.dot(a), mb = m.dot(b);
      const T det = aa * bb - ab * ab;
      return {mm - (bb * ma * ma - T(2.0) * ab * ma * mb + aa * mb * mb) / det, det};
    }
  }
};

/// Two features with their closest points inside.
template <int D, int P>
struct Stencil {
  std::array<Vector<double, D>, P> position;
  Vector<double, D> normal;  // from the second feature to the first
};

/// At a distance. Sides are some 1 long and at least .5 rad from parallel.
template <class L, int D>
Stencil<D, L::participants> stencil_at(double distance, Uniform& draw) {
  const auto vector = [&] {
    Vector<double, D> x;
    for (double& c : x) c = draw(-1, 1);
    return x;
  };
  const auto unit = [&] {
    Vector<double, D> x;
    do x = vector();
    while (x.norm() < 0.2 || x.norm() > 1);
    return Vector<double, D>(x.normalized());
  };
  constexpr int P = L::participants;
  Stencil<D, P> s;
  const Vector<double, D> origin = vector();
  const Vector<double, D> a = draw(0.8, 1.2) * unit();
  s.normal = unit();
  if constexpr (P > 2) {
    if constexpr (D == 2) {
      s.normal = Vector<double, D>(-a[1], a[0]).normalized();
    } else {
      Vector<double, D> b = unit();
      while (a.cross(b).norm() < 0.5 * a.norm()) b = unit();
      b *= draw(0.8, 1.2);
      s.normal = a.cross(b).normalized();
      if constexpr (P == 4 && is_of_edges<L>) {
        const double along_a = draw(0.3, 0.7), along_b = draw(0.3, 0.7);
        const Vector<double, D> low = origin + along_b * b, high = low + distance * s.normal;
        s.position = {high - along_a * a, high + (1 - along_a) * a, origin, origin + b};
        return s;
      } else if constexpr (P == 4) {
        const double along_a = draw(0.25, 0.4), along_b = draw(0.25, 0.4);
        s.position = {origin + along_a * a + along_b * b + distance * s.normal, origin, origin + a,
                      origin + b};
        return s;
      }
    }
  }
  if constexpr (P == 2) s.position = {origin + distance * s.normal, origin};
  if constexpr (P == 3) s.position = {origin + draw(0.3, 0.7) * a + distance * s.normal, origin, origin + a};
  return s;
}

/// Stiffness 1000 N/m, thickness .1 m, then a gap; of a power; parallel: c of the stencil times some number.
template <class L, int D>
std::vector<double> parameters_for(const Stencil<D, L::participants>& s, double gap, double power,
                                   double times = 1.5) {
  std::vector<double> c{1000.0, 0.1, gap};
  if (!is_log<L>) c.push_back(power);
  if (is_mollified<L>) c.push_back(times * ByGram<L>::squared_distance(s.position)[1]);
  return c;
}

/// In another type of number, exactly.
template <class T, int D, int P>
Participants<T, D, P> participants_of(const std::array<Vector<double, D>, P>& x) {
  Participants<T, D, P> p;
  for (int i = 0; i < P; ++i) {
    for (int c = 0; c < D; ++c) p.position[i][c] = T(x[i][c]);
    p.velocity[i] = Vector<T, D>::Constant(T(0.0));
    p.mass[i] = T(1.0);
  }
  p.time = T(0.0);
  return p;
}

/// f(p, the parameters ...).
template <class L, class T, class F, class P>
auto with_parameters(const P& p, const std::vector<double>& c, F f) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return f(p, T(c[I])...);
  }(std::make_index_sequence<L::parameters.size()>{});
}

}  // namespace jetlag::testing::contact
