// SPDX-License-Identifier: MIT
#pragma once
// Barriers of two edges that are nearly parallel and whose closest points are not inside both.

#include "jetlag/forces/contact/barrier.hpp"

namespace jetlag {

namespace detail {

/// The energy of a stencil times the factor M(c) of edges (x_0, x_1) and (x_2, x_3); see MollifiedEdgeEdge. Forces follow from it.
template <class Distance>
struct NearlyParallel {
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array parameters = joined(RationalBarrier::parameters, MollifiedEdgeEdge::parameters);
  static constexpr bool unbounded = true;

  template <class T>
  static T energy(const Participants<T, 3, 4>& p, const T& stiffness, const T& thickness, const T& gap,
                  const T& power, const T& parallel) {
    const auto& x = p.position;
    const Vector<T, 3> n = cross<T>(Vector<T, 3>(x[1] - x[0]), Vector<T, 3>(x[2] - x[3]));
    const T ratio = T(n.squaredNorm()) / parallel;
    return RationalBarrier::At<T>(Distance::squared(x), stiffness, thickness, gap, power).energy() *
           T(ratio * (T(2.0) - ratio));
  }
};
struct FirstVertices {
  template <class T>
  static T squared(const std::array<Vector<T, 3>, 4>& x) {
    return VertexVertex::At<T, 3>({x[0], x[2]}).u;
  }
};
struct FirstVertexAndSecondEdge {
  template <class T>
  static T squared(const std::array<Vector<T, 3>, 4>& x) {
    return VertexEdge::At<T, 3>({x[0], x[2], x[3]}).u;
  }
};

}  // namespace detail

/// BarrierMollifiedEdgeEdge where the closest points of the edges (x_0, x_1) and (x_2, x_3) are x_0 and x_2: the same factor, of
/// the distance of these two.
struct BarrierMollifiedVertexVertex : detail::NearlyParallel<detail::FirstVertices> {
  static constexpr const char* name = "barrier_mollified_vertex_vertex";
};

/// The same where they are x_0 and a point inside (x_2, x_3).
struct BarrierMollifiedVertexEdge : detail::NearlyParallel<detail::FirstVertexAndSecondEdge> {
  static constexpr const char* name = "barrier_mollified_vertex_edge";
};

extern template RecordedLaw record_law<BarrierMollifiedVertexVertex>(int);  // recorded in src/forces
extern template RecordedLaw record_law<BarrierMollifiedVertexEdge>(int);

}  // namespace jetlag
