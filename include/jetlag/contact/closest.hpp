// SPDX-License-Identifier: MIT
#pragma once
// The closest points of two small sets that surfaces are made of: a vertex, an edge, a face. Two of them are a stencil; the
// vertices of the one are its side A, those of the other its side B. The closest points are averages of the vertices, so
// that the way from B to A is a sum of positions with weights, and the weights share a contact force out: f b_i n on vertex
// i is the gradient of a potential of the distance, keeps the momentum, as the weights add up to 0, and the angular
// momentum, as it acts along the way.
//
//   region of a stencil      vertex_face: 3 vertex_vertex, 3 vertex_edge, 1 vertex_face
//   (which vertices the      edge_edge:   4 vertex_vertex, 4 vertex_edge, 1 edge_edge
//   closest points need)     vertex_edge: 2 vertex_vertex, 1 vertex_edge

#include <Eigen/Core>
#include <array>
#include <span>

namespace jetlag {

/// Vertices in this order: (p; q), (p; a, b), (p; a, b, c), (p_0, p_1; q_0, q_1). Side A stands before the semicolon.
enum class StencilKind { vertex_vertex, vertex_edge, vertex_face, edge_edge };

/// How many vertices a stencil has: 2 to 4.
constexpr int vertices_of(StencilKind kind) {
  return kind == StencilKind::vertex_vertex ? 2 : kind == StencilKind::vertex_edge ? 3 : 4;
}

/// How many of them, the first ones, are side A.
constexpr int first_side(StencilKind kind) { return kind == StencilKind::edge_edge ? 2 : 1; }

struct Closest {
  /// Weights b_i [1]: side A has 0 <= b_i <= 1 and the sum 1, side B -1 <= b_i <= 0 and the sum -1. They are multiples of
  /// 2^-52, so that all sums of them are exact. 0 for the vertices that the region has not, and beyond the stencil.
  std::array<double, 4> b;
  /// The way from B to A [m]: sum_i b_i x_i = d n.
  Eigen::Vector3d way;
  /// Its length d [m]. Where it is 0, n = way / d does not exist.
  double distance;
  /// The smallest stencil that has the same closest points, and which vertices of the given one it consists of, in its own
  /// order; -1 beyond. Of an edge_edge it may be a vertex of side B and the edge of side A: (q_1; p_0, p_1) is {3, 0, 1}.
  StencilKind region;
  std::array<int, 4> vertices;
};

/// The closest points of the stencil with the vertices x [m], in the order of its kind; a scene in the plane has z = 0.
///
/// On the border of two regions it is the one with fewer vertices. Edges are parallel where |e_1 x e_2|^2 <=
/// 1e-12 |e_1|^2 |e_2|^2: then the closest points are not unique, or hardly so, and those in the middle of the overlap are
/// taken; d is that of the middle, by at most 1e-6 |e| larger than the smallest. An edge without length is its first end, and
/// a face without area its edges.
/// Source: C. Ericson, Real-Time Collision Detection (2005), 5.1: vertices, then edges, then the inside.
/// Range: squares of squares of lengths neither over- nor underflow.   Contract: as many vertices as the kind has.
Closest closest(StencilKind kind, std::span<const Eigen::Vector3d> x);

}  // namespace jetlag
