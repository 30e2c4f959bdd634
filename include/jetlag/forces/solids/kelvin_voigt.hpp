// SPDX-License-Identifier: MIT
#pragma once
// Viscosity of solids, beside any of the elastic laws: these then read no velocities.

#include "jetlag/forces/solids/stvk.hpp"

namespace jetlag {

namespace detail {

/// See KelvinVoigt.
template <int D>
struct KelvinVoigtSimplex {
  static constexpr int participants = D + 1;
  static constexpr std::array dimensions{D};
  static constexpr auto material = [] {
    if constexpr (D == 3)
      return std::array{"viscosity_lambda", "viscosity_mu"};
    else
      return std::array{"viscosity_lambda", "viscosity_mu", "thickness"};
  }();
  static constexpr auto parameters = [] {
    if constexpr (D == 3)
      return std::array{"tension_0000", "tension_0001", "tension_0002", "tension_0011", "tension_0012",
                        "tension_0022", "tension_0101", "tension_0102", "tension_0111", "tension_0112",
                        "tension_0122", "tension_0202", "tension_0211", "tension_0212", "tension_0222",
                        "tension_1111", "tension_1112", "tension_1122", "tension_1212", "tension_1222",
                        "tension_2222"};
    else
      return std::array{"tension_0000", "tension_0001", "tension_0011",
                        "tension_0101", "tension_0111", "tension_1111"};
  }();

  /// lambda, mu [Pa s], mu >= 0, 3 lambda + 2 mu >= 0; thickness [m], > 0.
  template <class T>
  static std::array<T, parameters.size()> at_rest(const std::array<Vector<T, D>, D + 1>& x, const T& lambda,
                                                  const T& mu, const T& thickness = T(1)) {
    if (!(mu >= T(0))) throw std::invalid_argument("viscosity_mu must be >= 0, got " + text_of(mu) + " Pa s");
    if (!(T(3) * lambda + T(2) * mu >= T(0)))
      throw std::invalid_argument("viscosity_lambda must be >= -2/3 viscosity_mu, got " + text_of(lambda) +
                                  " Pa s");
    const auto rest = rest_shape<T, D>(x);
    return tension_matrix<T, D>(rest, volume_of_material(rest, thickness), lambda, mu);
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, D> forces(const Participants<T, D, D + 1>& p, const C&... parameters) {
    const auto d = edges<T, D>(p.position), w = edges<T, D>(p.velocity);
    Symmetric<T, D> rate;  // -G', elements beside the diagonal counted twice
    for (int a = 0; a < pairs_of_edges<D>; ++a) {
      const auto [i, j] = pair_of_edges<D>(a);
      rate[a] = T(-2.0) * (i == j ? T(d[i].dot(w[i])) : T(T(d[i].dot(w[j])) + T(w[i].dot(d[j]))));
    }
    const auto minus_t = tensions<D>(Symmetric<T, pairs_of_edges<D>>{parameters...}, rate);
    std::array<Vector<T, D>, D> f;
    for (int i = 0; i < D; ++i) f[i] = row_times<T, D>(minus_t, i, d);
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

/// The same of a triangle of a thickness, in plane strain.
struct PlaneKelvinVoigt : detail::KelvinVoigtSimplex<2> {
  static constexpr const char* name = "plane_kelvin_voigt";
};

extern template RecordedLaw record_law<KelvinVoigt>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneKelvinVoigt>(int);

}  // namespace jetlag
