// SPDX-License-Identifier: MIT
#pragma once
// Neo-Hookean solids: tetrahedra, and triangles in plane strain.

#include "jetlag/forces/solids/simplex.hpp"

namespace jetlag {

namespace detail {

/// What the neo-Hookean laws know of an element.
template <class T, int D>
struct NeoHookeanElement {
  Symmetric<T, D> stiffness;   // A = mu V H [N/m]
  T rest_determinant;          // Delta_0 = D! times the volume at rest [m^D]
  T lambda_volume, mu_volume;  // lambda V, mu V [J]
};

template <int D>
struct OfNeoHookean {
  static constexpr int participants = D + 1;
  static constexpr std::array dimensions{D};
  static constexpr auto material = elastic_material<D>();
  static constexpr auto parameters = [] {
    if constexpr (D == 3)
      return std::array{"stiffness_00", "stiffness_01",     "stiffness_02",  "stiffness_11", "stiffness_12",
                        "stiffness_22", "rest_determinant", "lambda_volume", "mu_volume"};
    else
      return std::array{"stiffness_00",     "stiffness_01",  "stiffness_11",
                        "rest_determinant", "lambda_volume", "mu_volume"};
  }();

 protected:
  template <class T, class... C>
    requires(sizeof...(C) == parameters.size())
  static NeoHookeanElement<T, D> element(const C&... c) {
    constexpr std::size_t n = D * (D + 1) / 2;
    const std::array<T, n + 3> all{c...};
    NeoHookeanElement<T, D> e;
    for (std::size_t i = 0; i < n; ++i) e.stiffness[i] = all[i];
    e.rest_determinant = all[n];
    e.lambda_volume = all[n + 1];
    e.mu_volume = all[n + 2];
    return e;
  }

  /// q c_i - sum_j A_ij d_j, as a sum of which all terms are added: a tape has one operation for it.
  template <class T>
  static std::array<Vector<T, D>, D> sum_of(const T& q, const Edges<T, D>& c, const Symmetric<T, D>& a,
                                            const Edges<T, D>& d) {
    Symmetric<T, D> minus_a;
    for (std::size_t i = 0; i < a.size(); ++i) minus_a[i] = -a[i];
    std::array<Vector<T, D>, D> f;
    for (int i = 0; i < D; ++i) f[i] = q * c[i] + row_times<T, D>(minus_a, i, d);
    return f;
  }

  /// sum_ij A_ij d_i . d_j = mu V H:G [J].
  template <class T>
  static T quadratic(const NeoHookeanElement<T, D>& e, const Edges<T, D>& d) {
    T sum = d[0].dot(row_times<T, D>(e.stiffness, 0, d));
    for (int i = 1; i < D; ++i) sum += d[i].dot(row_times<T, D>(e.stiffness, i, d));
    return sum;
  }

  /// The parameters of a rest shape and the two constants of the law [Pa].
  template <class T>
  static std::array<T, parameters.size()> at_rest_of(const std::array<Vector<T, D>, D + 1>& x,
                                                     const T& lambda, const T& mu, const T& thickness) {
    const auto rest = rest_shape<T, D>(x);
    const T volume = volume_of_material(rest, thickness);
    std::array<T, parameters.size()> c;
    constexpr std::size_t n = D * (D + 1) / 2;
    for (std::size_t i = 0; i < n; ++i) c[i] = mu * volume * rest.inverse_gram[i];
    c[n] = rest.determinant;
    c[n + 1] = lambda * volume;
    c[n + 2] = mu * volume;
    return c;
  }
};

/// See NeoHookean.
template <int D>
struct NeoHookeanSimplex : OfNeoHookean<D> {
  /// lambda, mu: Lame's constants [Pa], mu > 0, 3 lambda + 2 mu > 0; thickness [m], > 0.
  template <class T>
  static auto at_rest(const std::array<Vector<T, D>, D + 1>& x, const T& lambda, const T& mu,
                      const T& thickness = T(1)) {
    require_elastic(lambda, mu);
    return OfNeoHookean<D>::at_rest_of(x, lambda, mu, thickness);
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, D> forces(const Participants<T, D, D + 1>& p, const C&... parameters) {
    using std::log;
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position), c = cofactors(d);
    const T delta = d[0].dot(c[0]);
    const T pull = (e.mu_volume - e.lambda_volume * log(T(delta / e.rest_determinant))) / delta;
    return OfNeoHookean<D>::sum_of(pull, c, e.stiffness, d);
  }

  template <class T, class... C>
  static T energy(const Participants<T, D, D + 1>& p, const C&... parameters) {
    using std::log;
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position);
    const T log_j = log(T(T(d[0].dot(cofactors(d)[0])) / e.rest_determinant));
    return T(0.5) * (OfNeoHookean<D>::quadratic(e, d) - T(double(D)) * e.mu_volume) +
           (T(0.5) * e.lambda_volume * log_j - e.mu_volume) * log_j;
  }
};

}  // namespace detail

/// f_i = -sum_j A_ij d_j - V (lambda log J - mu) c_i / Delta,   A = mu V H,
/// E = V (mu/2 (I - 3) - mu log J + lambda/2 log^2 J),   I = H:G = tr F^T F,   J = Delta / Delta_rest = det F,
/// G_ij = d_i . d_j the Gram matrix of the edges d_i = x_i - x_3, H its inverse at rest, V the volume at rest; Delta, c: see cofactors.
/// Source: J. Bonet, R. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, chapter 6.
/// Range: J > 0. Energy and force grow without bounds towards J = 0, so that an element never turns inside out, but a step
/// may be too long: then the force is not finite.
/// Its stiffness grows as elements are compressed. Conserves: momentum, angular momentum, energy.
struct NeoHookean : detail::NeoHookeanSimplex<3> {
  static constexpr const char* name = "neo_hookean";
};

/// The same of a triangle, a slice of a given thickness that keeps it (plane strain): I = H:G + 1, Delta twice the area.
/// Plane stress there is none: the stretch across would be the root of a transcendental equation; plane_stvk has it.
struct PlaneNeoHookean : detail::NeoHookeanSimplex<2> {
  static constexpr const char* name = "plane_neo_hookean";
};

extern template RecordedLaw record_law<NeoHookean>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneNeoHookean>(int);

}  // namespace jetlag
