// SPDX-License-Identifier: MIT
#pragma once
// Corotated linear elasticity: tetrahedra, and triangles in plane strain.

#include "jetlag/forces/solids/neo_hookean.hpp"
#include "jetlag/series/elementary.hpp"

namespace jetlag {

/// E = V (mu |F - R|^2 + lambda/2 (a - 3)^2),   P = 2 mu (F + t R),   t = lambda/(2 mu) (a - 3) - 1,
/// R the rotation next to F, a = tr R^T F the sum of the principal stretches, the smallest < 0 where det F < 0.
/// The columns of F in the rest frame are e_k = sum_i B_ik d_i, d_i = x_i - x_3, with a triangular B for which they are
/// orthogonal and of length 1 at rest: f_i = -2 mu V sum_k B_ik (e_k + t R_k). With a and b the invariants of the stretch
/// (series/functions/stretch_invariants.hpp), C_kl = e_k . e_l, c the cofactors of e, q = a b - J,
///     q R_k = (tr C + b) e_k - sum_l C_kl e_l + a c_k,   R_2 = R_1 x R_0.
/// Source: A. McAdams et al., Efficient elasticity for character skinning, ACM Trans. Graph. 30 (2011) 37; for R Hoger and
/// Carlson 1984 (see stretch_invariants).
/// Range: q > 0. Elements may be flat or inside out, but for those two of whose principal stretches add up to zero (beyond
/// flat: a mirror image is one), where R jumps.   Conserves: momentum, angular momentum, energy.
struct Corotated {
  static constexpr const char* name = "corotated";
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr auto material = detail::elastic_material<3>();
  static constexpr std::array parameters{"frame_00", "frame_01", "frame_02",      "frame_11",
                                         "frame_12", "frame_22", "lambda_volume", "mu_volume"};

  /// lambda, mu: Lame's constants [Pa], mu > 0, 3 lambda + 2 mu > 0. B [1/m] by Gram and Schmidt.
  template <class T>
  static std::array<T, 8> at_rest(const std::array<Vector<T, 3>, 4>& x, const T& lambda, const T& mu) {
    using std::sqrt;
    detail::require_elastic(lambda, mu);
    const auto rest = detail::rest_shape<T, 3>(x);
    const auto& [g_00, g_01, g_02, g_11, g_12, g_22] = rest.gram;
    const T h_02 = rest.inverse_gram[2], h_12 = rest.inverse_gram[4], h_22 = rest.inverse_gram[5];
    const T length = sqrt(g_00), b_22 = sqrt(h_22), b_11 = length / (rest.determinant * b_22);
    return {T(T(1) / length),          T(-(g_01 / g_00) * b_11), T(h_02 / b_22), b_11, T(h_12 / b_22), b_22,
            T(lambda * rest.volume()), T(mu * rest.volume())};
  }

  template <class T, class... P>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 4>& p, const P&... parameters) {
    const std::array<T, 8> all{parameters...};
    const auto e = columns<T>(p, all);
    const auto [c_00, c_01, c_02, c_11, c_12, c_22] = gram(e);
    const auto cofactor = detail::cofactors(e);
    const T j = e[0].dot(cofactor[0]);
    const auto [a, b] = invariants<T>({c_00, c_01, c_02, c_11, c_12, c_22}, j);
    const T q = a * b - j, ratio = T(0.5) * T(all[6] / all[7]);
    const T t = ratio * a - T(T(1.0) + T(3.0) * ratio);
    const Vector<T, 3> x_0 = T(b + c_11 + c_22) * e[0] + T(-c_01) * e[1] + T(-c_02) * e[2] + a * cofactor[0],
                       x_1 = T(-c_01) * e[0] + T(b + c_00 + c_22) * e[1] + T(-c_12) * e[2] + a * cofactor[1],
                       r_1 = x_1 / q, stress_0 = T(t / q) * x_0;  // stress: t R_k
    const detail::Edges<T, 3> stress{e[0] + stress_0, e[1] + t * r_1, e[2] + detail::cross<T>(r_1, stress_0)};
    const T scale = T(-2.0) * all[7];
    std::array<Vector<T, 3>, 3> f;
    for (int i = 0; i < 3; ++i) {
      f[i] = T(scale * all[detail::place<3>(i, i)]) * stress[i];
      for (int k = i + 1; k < 3; ++k) f[i] += T(scale * all[detail::place<3>(i, k)]) * stress[k];
    }
    return f;
  }

  template <class T, class... P>
  static T energy(const Participants<T, 3, 4>& p, const P&... parameters) {
    const std::array<T, 8> all{parameters...};
    const auto e = columns<T>(p, all);
    const auto c = gram(e);
    const T a = invariants<T>(c, T(e[0].dot(detail::cofactors(e)[0]))).first, dilation = a - T(3.0);
    return all[7] * (c[0] + c[3] + c[5] - T(2.0) * a + T(3.0)) + T(0.5) * all[6] * dilation * dilation;
  }

 private:
  /// e_k = sum_i B_ik d_i.
  template <class T>
  static detail::Edges<T, 3> columns(const Participants<T, 3, 4>& p, const std::array<T, 8>& frame) {
    const auto d = detail::edges<T, 3>(p.position);
    detail::Edges<T, 3> e;
    for (int k = 0; k < 3; ++k) {
      e[k] = frame[detail::place<3>(0, k)] * d[0];
      for (int i = 1; i <= k; ++i) e[k] += frame[detail::place<3>(i, k)] * d[i];
    }
    return e;
  }
  /// C_kl = e_k . e_l.
  template <class T>
  static detail::Symmetric<T, 3> gram(const detail::Edges<T, 3>& e) {
    return {e[0].squaredNorm(), e[0].dot(e[1]), e[0].dot(e[2]),
            e[1].squaredNorm(), e[1].dot(e[2]), e[2].squaredNorm()};
  }
  /// a, b.
  template <class T>
  static std::pair<T, T> invariants(const detail::Symmetric<T, 3>& c, const T& j) {
    const T diagonal = T(c[0] * c[3]) + T(c[3] * c[5]) + T(c[5] * c[0]);
    return stretch_invariants(T(c[0] + c[3] + c[5]),
                              T(diagonal - T(T(c[1] * c[1]) + T(c[2] * c[2]) + T(c[4] * c[4]))), j);
  }
};

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

extern template RecordedLaw record_law<Corotated>(int);  // recorded in src/forces
extern template RecordedLaw record_law<PlaneCorotated>(int);

}  // namespace jetlag
