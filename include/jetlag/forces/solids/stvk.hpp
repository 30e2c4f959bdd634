// SPDX-License-Identifier: MIT
#pragma once
// Saint Venant-Kirchhoff solids, linear in Green's strain: tetrahedra, and triangles in the plane. Those in space are in
// forces/cloth/membrane.hpp.

#include <algorithm>
#include <array>
#include <utility>

#include "jetlag/forces/solids/simplex.hpp"

namespace jetlag {

namespace detail {

/// S(S + 1)/2 pairs 00 01 02 11 12 22 of S edges.
template <int S>
constexpr int pairs_of_edges = S * (S + 1) / 2;
template <int S>
constexpr std::pair<int, int> pair_of_edges(int a) {
  int i = 0;
  while (a >= S - i) a -= S - i++;
  return {i, i + a};
}

/// K with T_ij = sum_kl K_ijkl g_kl [N/m], where T = V (lambda/2 (H:g) H + mu H g H):
///     K_ijkl = V (lambda/2 H_ij H_kl + mu/2 (H_ik H_jl + H_il H_jk)).
template <class T, int S>
Symmetric<T, pairs_of_edges<S>> tension_matrix(const RestShape<T, S>& rest, const T& volume, const T& lambda,
                                               const T& mu) {
  constexpr int n = pairs_of_edges<S>;
  Symmetric<T, n> matrix;
  const auto h = [&](int i, int j) { return rest.inverse_gram[place<S>(i, j)]; };
  for (int a = 0; a < n; ++a)
    for (int b = a; b < n; ++b) {
      const auto [i, j] = pair_of_edges<S>(a);
      const auto [k, l] = pair_of_edges<S>(b);
      matrix[place<n>(a, b)] =
          volume * (lambda * h(i, j) * h(k, l) + mu * (h(i, k) * h(j, l) + h(i, l) * h(j, k))) / T(2);
    }
  return matrix;
}

/// T_a = sum_b K_ab g_b of g with elements beside the diagonal counted twice.
template <int S, class T>
Symmetric<T, S> tensions(const Symmetric<T, pairs_of_edges<S>>& matrix, const Symmetric<T, S>& g) {
  constexpr int n = pairs_of_edges<S>;
  Symmetric<T, S> t;
  for (int a = 0; a < n; ++a) {
    t[a] = matrix[place<n>(a, 0)] * g[0];
    for (int b = 1; b < n; ++b) t[a] += matrix[place<n>(a, b)] * g[b];
  }
  return t;
}

/// The names of a matrix by pairs of edges.
template <int S>
constexpr auto tension_names = [] {
  if constexpr (S == 3)
    return std::array{"tension_0000", "tension_0001", "tension_0002", "tension_0011", "tension_0012",
                      "tension_0022", "tension_0101", "tension_0102", "tension_0111", "tension_0112",
                      "tension_0122", "tension_0202", "tension_0211", "tension_0212", "tension_0222",
                      "tension_1111", "tension_1112", "tension_1122", "tension_1212", "tension_1222",
                      "tension_2222"};
  else
    return std::array{"tension_0000", "tension_0001", "tension_0011",
                      "tension_0101", "tension_0111", "tension_1111"};
}();

/// See Stvk; a simplex of S edges in a space of D dimensions.
template <int S, int D = S>
struct StvkSimplex {
  static constexpr int participants = S + 1;
  static constexpr std::array dimensions{D};
  static constexpr auto material = elastic_material<S>();
  static constexpr auto parameters = [] {
    std::array<const char*, tension_names<S>.size() + pairs_of_edges<S>> all;
    constexpr auto grams = [] {
      if constexpr (S == 3)
        return std::array{"rest_gram_00", "rest_gram_01", "rest_gram_02",
                          "rest_gram_11", "rest_gram_12", "rest_gram_22"};
      else
        return std::array{"rest_gram_00", "rest_gram_01", "rest_gram_11"};
    }();
    std::ranges::copy(grams, std::ranges::copy(tension_names<S>, all.begin()).out);
    return all;
  }();

  /// lambda, mu: Lame's constants [Pa], mu > 0, S lambda + 2 mu > 0; thickness [m], > 0.
  template <class T>
  static std::array<T, parameters.size()> at_rest(const std::array<Vector<T, D>, S + 1>& x, const T& lambda,
                                                  const T& mu, const T& thickness = T(1)) {
    require_elastic<S>(lambda, mu);
    const auto rest = rest_shape<T, D, S>(x);
    const auto matrix = tension_matrix<T, S>(rest, volume_of_material(rest, thickness), lambda, mu);
    std::array<T, parameters.size()> c;
    for (std::size_t a = 0; a < matrix.size(); ++a) c[a] = matrix[a];
    for (std::size_t a = 0; a < rest.gram.size(); ++a) c[matrix.size() + a] = rest.gram[a];
    return c;
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, S> forces(const Participants<T, D, S + 1>& p, const C&... parameters) {
    const auto d = edges<T, D>(p.position);
    const Element<T> e(parameters...);
    const auto minus_t = tensions<S>(e.matrix, e.shortening(d));
    std::array<Vector<T, D>, S> f;
    for (int i = 0; i < S; ++i) f[i] = row_times<T, D>(minus_t, i, d);
    return f;
  }

  template <class T, class... C>
  static T energy(const Participants<T, D, S + 1>& p, const C&... parameters) {
    const Element<T> e(parameters...);
    const auto g = e.shortening(edges<T, D>(p.position));
    const auto t = tensions<S>(e.matrix, g);
    T sum = t[0] * g[0];
    for (std::size_t a = 1; a < g.size(); ++a) sum += t[a] * g[a];
    return T(0.25) * sum;
  }

 private:
  template <class T>
  struct Element {
    static constexpr int n = pairs_of_edges<S>;
    Symmetric<T, n> matrix;
    Symmetric<T, S> rest_gram;

    template <class... C>
    explicit Element(const C&... c) {
      const std::array<T, parameters.size()> all{c...};
      for (std::size_t a = 0; a < matrix.size(); ++a) matrix[a] = all[a];
      for (int a = 0; a < n; ++a) rest_gram[a] = all[matrix.size() + a];
    }

    /// -(G - G0), elements beside the diagonal counted twice.
    Symmetric<T, S> shortening(const Edges<T, D, S>& d) const {
      Symmetric<T, S> g;
      for (int a = 0; a < n; ++a) {
        const auto [i, j] = pair_of_edges<S>(a);
        g[a] = i == j ? T(rest_gram[a] - d[i].squaredNorm())
                      : T(T(-2.0) * d[i].dot(d[j]) + (rest_gram[a] + rest_gram[a]));
      }
      return g;
    }
  };
};

}  // namespace detail

/// f_i = -sum_j T_ij d_j,   T = V (lambda/2 (H:e) H + mu H e H),   e = G - G_rest,
/// E = V (lambda/8 (H:e)^2 + mu/4 tr(H e H e)),   G_ij = d_i . d_j the Gram matrix of the edges d_i = x_i - x_3,
/// H its inverse at rest, V the volume at rest: S = lambda tr(E) 1 + 2 mu E of Green's strain E.
/// Source: J. Bonet, R. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, chapter 6.
/// Range: everywhere, a polynomial of degree 3. It softens under compression: the force has its peak at a stretch of
/// 1/sqrt 3, and beyond a flat element (J = 0), V (lambda + 2 mu)/8 above rest, lies another state of rest, inside out.
/// Conserves: momentum, angular momentum, energy.
struct Stvk : detail::StvkSimplex<3> {
  static constexpr const char* name = "stvk";
};

/// The same of a triangle of a thickness, in plane strain; with the constants `plane_stress` (forces/solids/lame.hpp) in
/// plane stress.
struct PlaneStvk : detail::StvkSimplex<2> {
  static constexpr const char* name = "plane_stvk";
};

extern template RecordedLaw record_law<Stvk>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneStvk>(int);

}  // namespace jetlag
