// SPDX-License-Identifier: MIT
#pragma once
// Neo-Hookean solids that may be turned inside out, and come back.

#include "jetlag/forces/solids/neo_hookean.hpp"

namespace jetlag {

namespace detail {

/// See StableNeoHookean. As in its source, the constants l, m of the law are those with which its small strains are those
/// of Lame's lambda, mu; the parameters lambda_volume and mu_volume are l V and m V.
template <int D>
struct StableNeoHookeanSimplex : OfNeoHookean<D> {
  /// l = lambda + 5 mu/6,   m = 4 mu/3.   lambda, mu: Lame's constants [Pa], mu > 0, 3 lambda + 2 mu > 0; thickness [m], > 0.
  template <class T>
  static auto at_rest(const std::array<Vector<T, D>, D + 1>& x, const T& lambda, const T& mu,
                      const T& thickness = T(1)) {
    require_elastic(lambda, mu);
    return OfNeoHookean<D>::at_rest_of(x, T(lambda + T(5) * mu / T(6)), T(T(4) * mu / T(3)), thickness);
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, D> forces(const Participants<T, D, D + 1>& p, const C&... parameters) {
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position), c = cofactors(d), w = weighted(e, d);
    const T share = T(1.0) - T(1.0) / invariant(e, d, w);
    const T pull =
        e.lambda_volume / e.rest_determinant * (rest_j(e) - T(d[0].dot(c[0])) / e.rest_determinant);
    std::array<Vector<T, D>, D> f;
    for (int i = 0; i < D; ++i) f[i] = pull * c[i] - share * w[i];
    return f;
  }

  template <class T, class... C>
  static T energy(const Participants<T, D, D + 1>& p, const C&... parameters) {
    using std::log;
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position);
    const T i_1 = invariant(e, d, weighted(e, d)), a = rest_j(e);
    const T j = T(d[0].dot(cofactors(d)[0])) / e.rest_determinant;
    return T(0.5) * (e.mu_volume * (i_1 - T(4.0) - log(T(T(0.25) * i_1))) +
                     e.lambda_volume * (j - T(1.0)) * (j + T(1.0) - a - a));
  }

 private:
  /// sum_j A_ij d_j.
  template <class T>
  static Edges<T, D> weighted(const NeoHookeanElement<T, D>& e, const Edges<T, D>& d) {
    Edges<T, D> w;
    for (int i = 0; i < D; ++i) w[i] = row_times<T, D>(e.stiffness, i, d);
    return w;
  }
  /// I + 1, with F_33 = 1 in the plane.
  template <class T>
  static T invariant(const NeoHookeanElement<T, D>& e, const Edges<T, D>& d, const Edges<T, D>& w) {
    T sum = d[0].dot(w[0]);
    for (int i = 1; i < D; ++i) sum += d[i].dot(w[i]);
    return sum / e.mu_volume + T(D == 3 ? 1.0 : 2.0);
  }
  /// a = 1 + 3m/(4l): there is no stress at rest.
  template <class T>
  static T rest_j(const NeoHookeanElement<T, D>& e) {
    return T(1.0) + T(0.75) * e.mu_volume / e.lambda_volume;
  }
};

/// See PolynomialNeoHookean.
template <int D>
struct PolynomialNeoHookeanSimplex : OfNeoHookean<D> {
  /// l = lambda + mu.   lambda, mu: Lame's constants [Pa], mu > 0, 3 lambda + 2 mu > 0; thickness [m], > 0.
  template <class T>
  static auto at_rest(const std::array<Vector<T, D>, D + 1>& x, const T& lambda, const T& mu,
                      const T& thickness = T(1)) {
    require_elastic(lambda, mu);
    return OfNeoHookean<D>::at_rest_of(x, T(lambda + mu), mu, thickness);
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, D> forces(const Participants<T, D, D + 1>& p, const C&... parameters) {
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position), c = cofactors(d);
    const T pull =
        e.lambda_volume / e.rest_determinant * (rest_j(e) - T(d[0].dot(c[0])) / e.rest_determinant);
    return OfNeoHookean<D>::sum_of(pull, c, e.stiffness, d);
  }

  template <class T, class... C>
  static T energy(const Participants<T, D, D + 1>& p, const C&... parameters) {
    const auto e = OfNeoHookean<D>::template element<T>(parameters...);
    const auto d = edges<T, D>(p.position);
    const T j = T(d[0].dot(cofactors(d)[0])) / e.rest_determinant, a = rest_j(e);
    return T(0.5) * (OfNeoHookean<D>::quadratic(e, d) - T(double(D)) * e.mu_volume +
                     e.lambda_volume * (j - T(1.0)) * (j + T(1.0) - a - a));
  }

 private:
  /// a = 1 + m/l: there is no stress at rest.
  template <class T>
  static T rest_j(const NeoHookeanElement<T, D>& e) {
    return T(1.0) + e.mu_volume / e.lambda_volume;
  }
};

}  // namespace detail

/// f_i = -(1 - 1/(I + 1)) sum_j A_ij d_j - l V (J - a) c_i / Delta_rest,   A = m V H,
/// E = V (m/2 (I - 3) - m/2 log((I + 1)/4) + l/2 ((J - a)^2 - (1 - a)^2)),
/// with l = lambda + 5 mu/6, m = 4 mu/3, a = 1 + 3m/(4l), and the letters of NeoHookean.
/// Source: B. Smith, F. de Goes, T. Kim, Stable neo-Hookean flesh simulation, ACM Trans. Graph. 37 (2018) 12.
/// Range: everywhere. An element that is flat or inside out comes back; the logarithm keeps the state without extension
/// (I = 0) from being one of rest.   Conserves: momentum, angular momentum, energy.
struct StableNeoHookean : detail::StableNeoHookeanSimplex<3> {
  static constexpr const char* name = "stable_neo_hookean";
};

/// The same of a triangle in plane strain, I = H:G + 1.
struct PlaneStableNeoHookean : detail::StableNeoHookeanSimplex<2> {
  static constexpr const char* name = "plane_stable_neo_hookean";
};

/// f_i = -sum_j A_ij d_j - l V (J - a) c_i / Delta_rest,   A = m V H,
/// E = V (m/2 (I - 3) + l/2 ((J - a)^2 - (1 - a)^2)),
/// with l = lambda + mu, m = mu, a = 1 + m/l, and the letters of NeoHookean: StableNeoHookean without its logarithm. The
/// force is a polynomial of degree 5, finite and cheap everywhere; an element without extension is in (unstable) balance.
/// Source: Smith et al. 2018 (see StableNeoHookean), section 3; l is chosen here so that small strains are those of
/// lambda, mu.   Conserves: momentum, angular momentum, energy.
struct PolynomialNeoHookean : detail::PolynomialNeoHookeanSimplex<3> {
  static constexpr const char* name = "polynomial_neo_hookean";
};

/// The same of a triangle in plane strain, I = H:G + 1.
struct PlanePolynomialNeoHookean : detail::PolynomialNeoHookeanSimplex<2> {
  static constexpr const char* name = "plane_polynomial_neo_hookean";
};

extern template RecordedLaw record_law<StableNeoHookean>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneStableNeoHookean>(int);
extern template RecordedLaw record_law<PolynomialNeoHookean>(int);
extern template RecordedLaw record_law<PlanePolynomialNeoHookean>(int);

}  // namespace jetlag
