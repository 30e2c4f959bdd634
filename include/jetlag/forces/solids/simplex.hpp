// SPDX-License-Identifier: MIT
#pragma once
// What the laws of tetrahedra (D = 3) and triangles (D = 2) have in common: their edges, cofactors and rest shapes. All is
// written in differences from the last vertex: no deformation gradient, no direction of the rest shape.

#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

#include "jetlag/forces/force.hpp"

namespace jetlag::detail {

/// d_i = x_i - x_D, i = 0 .. D-1 [m].
template <class T, int D>
using Edges = std::array<Vector<T, D>, D>;

template <class T, int D>
Edges<T, D> edges(const std::array<Vector<T, D>, D + 1>& x) {
  Edges<T, D> d;
  for (int i = 0; i < D; ++i) d[i] = x[i] - x[D];
  return d;
}

/// c_i = d Delta / d x_i [m^(D-1)], where Delta = d_0 . c_0 is D! times the volume of the simplex: > 0 where the vertices
/// are in the usual order, that is (x_1 - x_0) . ((x_2 - x_0) x (x_3 - x_0)) > 0, in the plane counterclockwise.
///     D = 3:  c_0 = d_2 x d_1,   c_1 = d_0 x d_2,   c_2 = d_1 x d_0;
///     D = 2:  c_0 = (d_1y, -d_1x),   c_1 = (-d_0y, d_0x).
template <class T>
Edges<T, 3> cofactors(const Edges<T, 3>& d) {
  Edges<T, 3> c;
  for (int i = 0; i < 3; ++i) {
    const Vector<T, 3>&a = d[(i + 2) % 3], &b = d[(i + 1) % 3];
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      c[i][axis] = T(a[next] * b[last]) - T(a[last] * b[next]);
    }
  }
  return c;
}
template <class T>
Edges<T, 2> cofactors(const Edges<T, 2>& d) {
  return {Vector<T, 2>(d[1][1], -d[1][0]), Vector<T, 2>(-d[0][1], d[0][0])};
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
template <class T, int D>
Vector<T, D> row_times(const Symmetric<T, D>& s, int i, const Edges<T, D>& d) {
  Vector<T, D> sum = s[place<D>(i, 0)] * d[0];
  for (int j = 1; j < D; ++j) sum += s[place<D>(i, j)] * d[j];
  return sum;
}

/// A simplex at rest.
template <class T, int D>
struct RestShape {
  T determinant;                 // Delta = D! times its volume [m^D], > 0
  Symmetric<T, D> gram;          // G0_ij = d_i . d_j [m^2]
  Symmetric<T, D> inverse_gram;  // H = G0^-1 [1/m^2];  h_i = c_i / Delta are dual to d_i, H_ij = h_i . h_j
  T volume() const { return determinant / T(D == 3 ? 6 : 2); }
};

template <class T>
std::string text_of(const T& x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

/// Throws std::invalid_argument that says what is wrong: flat, where a height is <= 1e-12 of the longest edge; a negative
/// volume; what is not finite is let through.
template <class T, int D>
RestShape<T, D> rest_shape(const std::array<Vector<T, D>, D + 1>& x) {
  using std::sqrt;
  const auto size = [](const T& a) { return a < T(0) ? T(-a) : a; };
  const auto d = edges<T, D>(x), c = cofactors(d);
  RestShape<T, D> rest;
  rest.determinant = d[0].dot(c[0]);
  // A height is Delta / |c_i|, that over the last vertex Delta / |sum c_i|.
  Vector<T, D> sum = c[0];
  for (int i = 1; i < D; ++i) sum += c[i];
  T steepest = sum.squaredNorm(), longest(0);
  for (int i = 0; i < D; ++i) steepest = c[i].squaredNorm() > steepest ? c[i].squaredNorm() : steepest;
  for (int i = 0; i <= D; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector<T, D> edge = x[i] - x[j];
      longest = edge.squaredNorm() > longest ? edge.squaredNorm() : longest;
    }
  if (size(rest.determinant) <= T(1e-12) * sqrt(longest) * sqrt(steepest))
    throw std::invalid_argument("flat at rest; every height must be > 1e-12 of the longest edge");
  if (rest.determinant < T(0))
    throw std::invalid_argument((D == 3 ? "volume " : "area ") + text_of(rest.volume()) +
                                (D == 3 ? " m^3" : " m^2") +
                                " at rest; must be > 0: exchange two of its vertices");
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      rest.gram[place<D>(i, j)] = d[i].dot(d[j]);
      rest.inverse_gram[place<D>(i, j)] = c[i].dot(c[j]) / rest.determinant / rest.determinant;
    }
  return rest;
}

/// The volume of the material of a simplex [m^3]: that of a triangle is its area times the thickness.
template <class T, int D>
T volume_of_material(const RestShape<T, D>& rest, const T& thickness) {
  if (!(thickness > T(0)))
    throw std::invalid_argument("thickness must be > 0, got " + text_of(thickness) + " m");
  return rest.volume() * thickness;
}

/// Throws std::invalid_argument unless mu > 0 and 3 lambda + 2 mu > 0: else there are strains without or with negative energy.
template <class T>
void require_elastic(const T& lambda, const T& mu) {
  if (!(mu > T(0))) throw std::invalid_argument("lame_mu must be > 0, got " + text_of(mu) + " Pa");
  if (!(T(3) * lambda + T(2) * mu > T(0)))
    throw std::invalid_argument("lame_lambda must be > -2/3 lame_mu, got " + text_of(lambda) + " Pa");
}

/// The material of an elastic simplex: the thickness is that of a triangle.
template <int D>
constexpr auto elastic_material() {
  if constexpr (D == 3)
    return std::array{"lame_lambda", "lame_mu"};
  else
    return std::array{"lame_lambda", "lame_mu", "thickness"};
}

}  // namespace jetlag::detail
