// SPDX-License-Identifier: MIT
#pragma once
// Corotated linear elasticity of triangles in plane strain.

#include "jetlag/forces/solids/neo_hookean.hpp"

namespace jetlag {

/// E = V (mu |F - R|^2 + lambda/2 (r - 2)^2),   R the rotation next to F, r = tr R^T F the sum of the principal stretches.
/// In the plane r^2 = I + 2 J, so that no rotation is needed:
///     E = V (mu (I - 2 r + 2) + lambda/2 (r - 2)^2),   r = sqrt(I + 2 J),
///     f_i = -(2 + g) sum_j A_ij d_j - g mu V c_i / Delta_rest,   g = (lambda/mu (r - 2) - 2) / r,
/// with I = H:G and the other letters of NeoHookean; F_33 = 1 (plane strain).
/// Source: A. McAdams et al., Efficient elasticity for character skinning, ACM Trans. Graph. 30 (2011) 37; Cayley and
/// Hamilton for r.
/// Range: r > 0. Elements may be flat or inside out, but for those turned over like a page (r = 0), where R jumps.
/// Conserves: momentum, angular momentum, energy.
struct PlaneCorotated : detail::OfNeoHookean<2> {
  static constexpr const char* name = "plane_corotated";

  /// lambda, mu: Lame's constants [Pa], mu > 0, 3 lambda + 2 mu > 0; thickness [m], > 0.
  template <class T>
  static auto at_rest(const std::array<Vector<T, 2>, 3>& x, const T& lambda, const T& mu,
                      const T& thickness) {
    detail::require_elastic(lambda, mu);
    return at_rest_of(x, lambda, mu, thickness);
  }

  template <class T, class... C>
  static std::array<Vector<T, 2>, 2> forces(const Participants<T, 2, 3>& p, const C&... parameters) {
    const auto e = element<T>(parameters...);
    const auto d = detail::edges<T, 2>(p.position), c = detail::cofactors(d);
    const detail::Edges<T, 2> w{detail::row_times<T, 2>(e.stiffness, 0, d),
                                detail::row_times<T, 2>(e.stiffness, 1, d)};
    const T r = stretch(e, d, c, w), ratio = e.lambda_volume / e.mu_volume;
    const T g = ratio - (T(2.0) * ratio + T(2.0)) / r, pull = g * T(e.mu_volume / e.rest_determinant);
    std::array<Vector<T, 2>, 2> f;
    for (int i = 0; i < 2; ++i) f[i] = T(T(-2.0) - g) * w[i] - pull * c[i];
    return f;
  }

  template <class T, class... C>
  static T energy(const Participants<T, 2, 3>& p, const C&... parameters) {
    const auto e = element<T>(parameters...);
    const auto d = detail::edges<T, 2>(p.position), c = detail::cofactors(d);
    const detail::Edges<T, 2> w{detail::row_times<T, 2>(e.stiffness, 0, d),
                                detail::row_times<T, 2>(e.stiffness, 1, d)};
    const T r = stretch(e, d, c, w), dilation = r - T(2.0);
    return T(d[0].dot(w[0])) + T(d[1].dot(w[1])) - T(2.0) * e.mu_volume * (r - T(1.0)) +
           T(0.5) * e.lambda_volume * dilation * dilation;
  }

 private:
  template <class T>
  static T stretch(const detail::NeoHookeanElement<T, 2>& e, const detail::Edges<T, 2>& d,
                   const detail::Edges<T, 2>& c, const detail::Edges<T, 2>& w) {
    using std::sqrt;
    const T i_1 = T(T(d[0].dot(w[0])) + T(d[1].dot(w[1]))) / e.mu_volume;
    return sqrt(T(i_1 + T(T(2.0) * d[0].dot(c[0])) / e.rest_determinant));
  }
};

extern template RecordedLaw record_law<PlaneCorotated>(int);  // recorded in src/forces

}  // namespace jetlag
