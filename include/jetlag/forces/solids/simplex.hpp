// SPDX-License-Identifier: MIT
#pragma once
// What the laws of tetrahedra (S = 3 edges) and triangles (S = 2), in the plane or in space (D = 2 or 3), have in common:
// their edges, cofactors and rest shapes. All is written in differences from the last vertex: no deformation gradient, no
// direction of the rest shape.

#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

#include "jetlag/forces/force.hpp"

namespace jetlag::detail {

/// d_i = x_i - x_S, i = 0 .. S-1 [m].
template <class T, int D, int S = D>
using Edges = std::array<Vector<T, D>, S>;

template <class T, int D, std::size_t P>
Edges<T, D, P - 1> edges(const std::array<Vector<T, D>, P>& x) {
  Edges<T, D, P - 1> d;
  for (std::size_t i = 0; i + 1 < P; ++i) d[i] = x[i] - x[P - 1];
  return d;
}

template <class T>
Vector<T, 3> cross(const Vector<T, 3>& a, const Vector<T, 3>& b) {
  Vector<T, 3> c;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    c[axis] = T(a[next] * b[last]) - T(a[last] * b[next]);
  }
  return c;
}

/// c_i = d Delta / d x_i [m^(S-1)], where Delta = d_0 . c_0 is S! times the volume of the simplex: > 0 where the vertices
/// are in the usual order, that is (x_1 - x_0) . ((x_2 - x_0) x (x_3 - x_0)) > 0, in the plane counterclockwise. That of a
/// triangle in space is > 0, since it has no outside.
///     tetrahedron:  c_0 = d_2 x d_1,   c_1 = d_0 x d_2,   c_2 = d_1 x d_0;
///     triangle in the plane:  c_0 = (d_1y, -d_1x),   c_1 = (-d_0y, d_0x);
///     triangle in space:  c_0 = d_1 x n,   c_1 = n x d_0,   n = d_0 x d_1 / |d_0 x d_1|;   0 where it is flat.
template <class T>
Edges<T, 3> cofactors(const Edges<T, 3>& d) {
  Edges<T, 3> c;
  for (int i = 0; i < 3; ++i) c[i] = cross<T>(d[(i + 2) % 3], d[(i + 1) % 3]);
  return c;
}
template <class T>
Edges<T, 2> cofactors(const Edges<T, 2>& d) {
  return {Vector<T, 2>(d[1][1], -d[1][0]), Vector<T, 2>(-d[0][1], d[0][0])};
}
template <class T>
Edges<T, 3, 2> cofactors(const Edges<T, 3, 2>& d) {
  using std::sqrt;
  Vector<T, 3> n = cross<T>(d[0], d[1]);
  const T twice_area = sqrt(n.squaredNorm());
  if (twice_area > T(0)) n /= twice_area;
  return {cross<T>(d[1], n), cross<T>(n, d[0])};
}

/// A symmetric matrix by its upper triangle, row by row: 00 01 02 11 12 22.
template <class T, int n>
using Symmetric = std::array<T, n*(n + 1) / 2>;

/// Where element ij of a symmetric matrix of n rows is.
template <int n>
constexpr int place(int i, int j) {
  return i <= j ? i * n - i * (i - 1) / 2 + j - i : place<n>(j, i);
}

/// sum_j S_ij d_j.
template <class T, int D, std::size_t S>
Vector<T, D> row_times(const Symmetric<T, int(S)>& s, int i, const std::array<Vector<T, D>, S>& d) {
  Vector<T, D> sum = s[place<S>(i, 0)] * d[0];
  for (std::size_t j = 1; j < S; ++j) sum += s[place<S>(i, j)] * d[j];
  return sum;
}

/// A simplex of S edges from a vertex, at rest.
template <class T, int S>
struct RestShape {
  T determinant;                 // Delta = S! times its volume [m^S], > 0
  Symmetric<T, S> gram;          // G0_ij = d_i . d_j [m^2]
  Symmetric<T, S> inverse_gram;  // H = G0^-1 [1/m^2];  h_i = c_i / Delta are dual to d_i, H_ij = h_i . h_j
  T volume() const { return determinant / T(S == 3 ? 6 : 2); }
};

template <class T>
std::string text_of(const T& x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

/// Throws std::invalid_argument that says what is wrong: flat, where a height is <= 1e-12 of the longest edge; a negative
/// volume; what is not finite is let through.
template <class T, int D, int S = D>
RestShape<T, S> rest_shape(const std::array<Vector<T, D>, S + 1>& x) {
  using std::sqrt;
  const auto size = [](const T& a) { return a < T(0) ? T(-a) : a; };
  const auto d = edges<T, D>(x), c = cofactors<T>(d);
  RestShape<T, S> rest;
  rest.determinant = d[0].dot(c[0]);
  // A height is Delta / |c_i|, that over the last vertex Delta / |sum c_i|.
  Vector<T, D> sum = c[0];
  for (int i = 1; i < S; ++i) sum += c[i];
  T steepest = sum.squaredNorm(), longest(0);
  for (int i = 0; i < S; ++i) steepest = c[i].squaredNorm() > steepest ? c[i].squaredNorm() : steepest;
  for (int i = 0; i <= S; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector<T, D> edge = x[i] - x[j];
      longest = edge.squaredNorm() > longest ? edge.squaredNorm() : longest;
    }
  if (size(rest.determinant) <= T(1e-12) * sqrt(longest) * sqrt(steepest))
    throw std::invalid_argument("flat at rest; every height must be > 1e-12 of the longest edge");
  if (rest.determinant < T(0))
    throw std::invalid_argument((S == 3 ? "volume " : "area ") + text_of(rest.volume()) +
                                (S == 3 ? " m^3" : " m^2") +
                                " at rest; must be > 0: exchange two of its vertices");
  for (int i = 0; i < S; ++i)
    for (int j = i; j < S; ++j) {
      rest.gram[place<S>(i, j)] = d[i].dot(d[j]);
      rest.inverse_gram[place<S>(i, j)] = c[i].dot(c[j]) / rest.determinant / rest.determinant;
    }
  return rest;
}

/// The volume of the material of a simplex [m^3]: that of a triangle is its area times the thickness.
template <class T, int S>
T volume_of_material(const RestShape<T, S>& rest, const T& thickness) {
  if (!(thickness > T(0)))
    throw std::invalid_argument("thickness must be > 0, got " + text_of(thickness) + " m");
  return rest.volume() * thickness;
}

/// Throws std::invalid_argument unless mu > 0 and n lambda + 2 mu > 0: else there are strains without or with negative
/// energy. They are of n dimensions: 3 also in plane strain, where lambda is that of the solid; 2 where it may be that of
/// plane stress.
template <int n = 3, class T>
void require_elastic(const T& lambda, const T& mu) {
  if (!(mu > T(0))) throw std::invalid_argument("lame_mu must be > 0, got " + text_of(mu) + " Pa");
  if (!(T(n) * lambda + T(2) * mu > T(0)))
    throw std::invalid_argument(std::string("lame_lambda must be > -") + (n == 3 ? "2/3 " : "") +
                                "lame_mu, got " + text_of(lambda) + " Pa");
}

/// The material of an elastic simplex: the thickness is that of a triangle.
template <int S>
constexpr auto elastic_material() {
  if constexpr (S == 3)
    return std::array{"lame_lambda", "lame_mu"};
  else
    return std::array{"lame_lambda", "lame_mu", "thickness"};
}

}  // namespace jetlag::detail
