// SPDX-License-Identifier: MIT
#pragma once
// Barriers: what keeps two features of surfaces apart, however fast they come.

#include <array>
#include <cmath>
#include <cstddef>

#include "jetlag/forces/contact/stencils.hpp"

namespace jetlag {

namespace detail {

/// V = k D/8 (1 - w)^3 w^-q,   -2 dV/du = k/4 (1 - w)^2 w^(-q-1) (q + (3 - q) w),   w = (u - xi^2) / D,   D = d_hat^2 + 2 xi d_hat.
struct RationalBarrier {
  static constexpr std::array parameters{"stiffness", "thickness", "gap", "power"};

  template <class T>
  struct At {
    T stiffness, width, power, w, beyond, common;  // D;  w - 1,  (1 - w)^2 w^(-q-1)

    At(const T& u, const T& stiffness, const T& thickness, const T& gap, const T& power)
        : stiffness(stiffness), width(thickness * (thickness + T(2.0) * gap)), power(power) {
      using std::pow;
      w = T(T(1.0) / width) * (u - T(gap * gap));
      beyond = w - T(1.0);
      common = T(beyond * beyond) * T(pow(w, T(-(power + T(1.0)))));
    }
    T energy() const { return T(stiffness * width / T(-8.0)) * (common * T(w * beyond)); }
    T pull() const {
      const T quarter = stiffness / T(4.0);
      return common * T(T(quarter * (T(3.0) - power)) * w + T(quarter * power));
    }
  };
};

/// V = -k (g - d_hat)^2 log(g/d_hat),   -2 dV/du = k/d (g - d_hat) (2 log(g/d_hat) + (g - d_hat)/g),   g = d - xi,   d = sqrt(u).
struct LogBarrier {
  static constexpr std::array parameters{"stiffness", "thickness", "gap"};

  template <class T>
  struct At {
    T stiffness, distance, inner, beyond, logarithm;  // d, g, g - d_hat

    At(const T& u, const T& stiffness, const T& thickness, const T& gap) : stiffness(stiffness) {
      using std::log, std::sqrt;
      distance = sqrt(u);
      inner = distance - gap;
      beyond = inner - thickness;
      logarithm = log(T(inner / thickness));
    }
    T energy() const { return -stiffness * (T(beyond * beyond) * logarithm); }
    T pull() const { return stiffness * (beyond * (T(2.0) * logarithm + T(beyond / inner))) / distance; }
  };
};

template <std::size_t m, std::size_t n>
constexpr auto joined(const std::array<const char*, m>& a, const std::array<const char*, n>& b) {
  std::array<const char*, m + n> all{};
  for (std::size_t i = 0; i < m + n; ++i) all[i] = i < m ? a[i] : b[i - m];
  return all;
}

/// V of the distance between the features of a stencil.
template <class Stencil, class Profile>
struct Barrier {
  static constexpr int participants = Stencil::participants;
  static constexpr std::array dimensions = Stencil::dimensions;
  static constexpr std::array parameters = joined(Profile::parameters, Stencil::parameters);
  static constexpr bool unbounded = true;

  template <class T, int D, class... C>
    requires(sizeof...(C) == parameters.size())
  static std::array<Vector<T, D>, participants - 1> forces(const Participants<T, D, participants>& p,
                                                           const C&... all) {
    const typename Stencil::template At<T, D> features(p.position);
    const std::array<T, sizeof...(C)> c{all...};
    const auto profile = profile_at(features.u, c);
    if constexpr (is_mollified)
      return features.forces(profile.pull(), profile.energy(), c.back());
    else
      return features.forces(profile.pull());
  }
  template <class T, int D, class... C>
    requires(sizeof...(C) == parameters.size())
  static T energy(const Participants<T, D, participants>& p, const C&... all) {
    const typename Stencil::template At<T, D> features(p.position);
    const std::array<T, sizeof...(C)> c{all...};
    const T energy = profile_at(features.u, c).energy();
    if constexpr (is_mollified)
      return energy * features.factor(c.back());
    else
      return energy;
  }

 private:
  static constexpr bool is_mollified = Stencil::parameters.size() > 0;

  template <class T, std::size_t n>
  static auto profile_at(const T& u, const std::array<T, n>& c) {
    using At = typename Profile::template At<T>;
    if constexpr (Profile::parameters.size() == 4)
      return At(u, c[0], c[1], c[2], c[3]);
    else
      return At(u, c[0], c[1], c[2]);
  }
};

}  // namespace detail

/// E = k D/8 (1 - w)^3 w^-q,   w = (d^2 - xi^2) / D,   D = d_hat^2 + 2 xi d_hat,
///     f_i = k/4 (1 - w)^2 w^(-q-1) (q + (3 - q) w)  b_i d n,
/// of the distance d of two vertices, x_0 and x_1. n is the unit vector between the closest points, from the second feature to the
/// first, and d n = sum_i b_i x_i.
///
/// stiffness k [N/m], >= 0; thickness d_hat [m], > 0; gap xi [m], >= 0; power q [1], 1 to 7, whole or not.
///
/// With y = (d - xi)/d_hat, between 0 where they would touch and 1 where the law begins to act, and xi = 0:
///     E -> k d_hat^2 (1 - y)^3    as y -> 1, so that the law begins with a force and a slope of zero, as QuadraticFloor;
///     E = k d_hat^2/8 y^(-2q)     as y -> 0:  7 makes it y^-14, as of Harmon's infinite stack of layers.
/// With a gap these are k d_hat (d_hat + xi)^3 / (d_hat + 2 xi)^2 (1 - y)^3, and k D/8 ((d_hat + 2 xi) / (2 xi y))^q.
/// No speed carries a particle through it: at v it turns back where E = m v^2 / 2, without a gap near
/// y = (k d_hat^2 / (4 m v^2))^(1/(2q)).
///
/// These are laws of elements that are on: d < xi + d_hat. There they are analytic. Who adds and takes away elements does so
/// where w = 1; a law that stays on beyond pulls the features together (1 < w), with E < 0.
///
/// Source: D. Harmon, E. Vouga, B. Smith, R. Tamstorf, E. Grinspun, Asynchronous contact mechanics, SIGGRAPH 2009 (y^-14);
/// M. Li et al., Incremental potential contact, SIGGRAPH 2020 (of d^2, shifted by xi^2 for a thickness). (1 - w)^3 w^-q is neither's.
/// Range: d > xi. At d = xi the force is not finite, below it has no meaning. Conserves: momentum, angular momentum, energy.
struct BarrierVertexVertex : detail::Barrier<detail::VertexVertex, detail::RationalBarrier> {
  static constexpr const char* name = "barrier_vertex_vertex";
};

/// The same of a vertex x_0 and the line through x_1 and x_2: of the edge, where x_0 is beside it.
/// Range: x_1 != x_2.
struct BarrierVertexEdge : detail::Barrier<detail::VertexEdge, detail::RationalBarrier> {
  static constexpr const char* name = "barrier_vertex_edge";
};

/// The same of a vertex x_0 and the plane through x_1, x_2 and x_3: of the face, where x_0 is above it, on either side.
/// Range: x_1, x_2 and x_3 not in line.
struct BarrierVertexFace : detail::Barrier<detail::VertexFace, detail::RationalBarrier> {
  static constexpr const char* name = "barrier_vertex_face";
};

/// The same of the line through x_0 and x_1 and that through x_2 and x_3: of the edges, where the closest points are on both.
/// Range: lines that are not parallel. Rounding of n = e_1 x e_2 turns the force by some 2^-52 |e_1| |e_2| / |n|.
struct BarrierEdgeEdge : detail::Barrier<detail::EdgeEdge, detail::RationalBarrier> {
  static constexpr const char* name = "barrier_edge_edge";
};

/// BarrierEdgeEdge of edges that are nearly parallel: E times
///     M(c) = c/eps (2 - c/eps),   c = |e_1 x e_2|^2,
/// which is 1, with slope 0, at c = eps, and vanishes with the angle between them. The formula is that of c < eps: beyond,
/// BarrierEdgeEdge takes its place. parallel eps [m^4], > 0: 1e-3 |e_1|^2 |e_2|^2 at rest.
/// Source: M. Li et al., as above.   Range: c > 0. At c = 0 neither n nor the force is defined.
struct BarrierMollifiedEdgeEdge : detail::Barrier<detail::MollifiedEdgeEdge, detail::RationalBarrier> {
  static constexpr const char* name = "barrier_mollified_edge_edge";
};

/// E = -k (g - d_hat)^2 log(g/d_hat),   g = d - xi;   k, d_hat and xi as above.
/// The barrier of implicit methods, to compare with: it too begins as k d_hat^2 (1 - y)^3. Near y = 0 it is too weak for steps that
/// do not search along a line: what it stops at comes as close as y = exp(-E / (k d_hat^2)).
/// Source: M. Li et al., as above.   Range: d > xi.   Conserves: momentum, angular momentum, energy.
struct LogBarrierVertexVertex : detail::Barrier<detail::VertexVertex, detail::LogBarrier> {
  static constexpr const char* name = "log_barrier_vertex_vertex";
};
struct LogBarrierVertexEdge : detail::Barrier<detail::VertexEdge, detail::LogBarrier> {
  static constexpr const char* name = "log_barrier_vertex_edge";
};
struct LogBarrierVertexFace : detail::Barrier<detail::VertexFace, detail::LogBarrier> {
  static constexpr const char* name = "log_barrier_vertex_face";
};
struct LogBarrierEdgeEdge : detail::Barrier<detail::EdgeEdge, detail::LogBarrier> {
  static constexpr const char* name = "log_barrier_edge_edge";
};
struct LogBarrierMollifiedEdgeEdge : detail::Barrier<detail::MollifiedEdgeEdge, detail::LogBarrier> {
  static constexpr const char* name = "log_barrier_mollified_edge_edge";
};

extern template RecordedLaw record_law<BarrierVertexVertex>(int);  // recorded in src/forces
extern template RecordedLaw record_law<BarrierVertexEdge>(int);
extern template RecordedLaw record_law<BarrierVertexFace>(int);
extern template RecordedLaw record_law<BarrierEdgeEdge>(int);
extern template RecordedLaw record_law<BarrierMollifiedEdgeEdge>(int);
extern template RecordedLaw record_law<LogBarrierVertexVertex>(int);
extern template RecordedLaw record_law<LogBarrierVertexEdge>(int);
extern template RecordedLaw record_law<LogBarrierVertexFace>(int);
extern template RecordedLaw record_law<LogBarrierEdgeEdge>(int);
extern template RecordedLaw record_law<LogBarrierMollifiedEdgeEdge>(int);

}  // namespace jetlag
