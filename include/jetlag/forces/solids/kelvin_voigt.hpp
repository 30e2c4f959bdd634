// SPDX-License-Identifier: MIT
#pragma once
// Viscosity of solids, beside any of the elastic laws: these then read no velocities.

#include "jetlag/forces/solids/stvk.hpp"

namespace jetlag {

namespace detail {

/// See KelvinVoigt; a simplex of S edges in a space of D dimensions.
template <int S, int D = S>
struct KelvinVoigtSimplex {
  static constexpr int participants = S + 1;
  static constexpr std::array dimensions{D};
  static constexpr auto material = [] {
    if constexpr (S == 3)
      return std::array{"viscosity_lambda", "viscosity_mu"};
    else
      return std::array{"viscosity_lambda", "viscosity_mu", "thickness"};
  }();
  static constexpr auto parameters = tension_names<S>;

  /// lambda, mu [Pa s], mu >= 0, S lambda + 2 mu >= 0; thickness [m], > 0.
  template <class T>
  static std::array<T, parameters.size()> at_rest(const std::array<Vector<T, D>, S + 1>& x, const T& lambda,
                                                  const T& mu, const T& thickness = T(1)) {
    if (!(mu >= T(0))) throw std::invalid_argument("viscosity_mu must be >= 0, got " + text_of(mu) + " Pa s");
    if (!(T(S) * lambda + T(2) * mu >= T(0)))
      throw std::invalid_argument(std::string("viscosity_lambda must be >= -") + (S == 3 ? "2/3 " : "") +
                                  "viscosity_mu, got " + text_of(lambda) + " Pa s");
    const auto rest = rest_shape<T, D, S>(x);
    return tension_matrix<T, S>(rest, volume_of_material(rest, thickness), lambda, mu);
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, S> forces(const Participants<T, D, S + 1>& p, const C&... parameters) {
    const auto d = edges<T, D>(p.position), w = edges<T, D>(p.velocity);
    Symmetric<T, S> rate;  // -G', elements beside the diagonal counted twice
    for (int a = 0; a < pairs_of_edges<S>; ++a) {
      const auto [i, j] = pair_of_edges<S>(a);
      rate[a] = T(-2.0) * (i == j ? T(d[i].dot(w[i])) : T(T(d[i].dot(w[j])) + T(w[i].dot(d[j]))));
    }
    const auto minus_t = tensions<S>(Symmetric<T, pairs_of_edges<S>>{parameters...}, rate);
    std::array<Vector<T, D>, S> f;
    for (int i = 0; i < S; ++i) f[i] = row_times<T, D>(minus_t, i, d);
    return f;
  }
};

}  // namespace detail

/// f_i = -sum_j T_ij d_j,   T = V (lambda/2 (H:G') H + mu H G' H),   G'_ij = d_i . w_j + w_i . d_j,   w_i = v_i - v_3,
/// with the letters of Stvk: S = lambda tr(E') 1 + 2 mu E' of the rate E' of Green's strain. Power
/// -V (lambda tr^2 E' + 2 mu E':E') <= 0; none in rigid motion, however stressed the body is.
/// viscosities [Pa s]: of lambda = b lambda_e, mu = b mu_e, in proportion to the elastic constants by a time b [s], a small
/// vibration of frequency omega has the damping ratio b omega / 2.
/// Source: W. Voigt 1892; in large strains as J. Simo, T. Hughes, Computational Inelasticity, chapter 10.
/// Conserves: momentum, angular momentum.
struct KelvinVoigt : detail::KelvinVoigtSimplex<3> {
  static constexpr const char* name = "kelvin_voigt";
};

/// The same of a triangle of a thickness, in plane strain; with constants of plane stress in that.
struct PlaneKelvinVoigt : detail::KelvinVoigtSimplex<2> {
  static constexpr const char* name = "plane_kelvin_voigt";
};

extern template RecordedLaw record_law<KelvinVoigt>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneKelvinVoigt>(int);

}  // namespace jetlag
