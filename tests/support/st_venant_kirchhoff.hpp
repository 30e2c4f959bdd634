// SPDX-License-Identifier: MIT
#pragma once
// Tetrahedra of St. Venant-Kirchhoff's elasticity, which the library does not have, and a box of them.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "jetlag/forces/force.hpp"
#include "jetlag/model/system.hpp"

namespace jetlag::testing {

/// E = V (lambda/8 (H:e)^2 + mu/4 tr(H e H e)), e = G - G_0, G_ij = d_i . d_j, d from the last participant to the others, G_0
/// the same at rest, H its inverse, V the volume at rest.   f_i = -sum_j T_ij d_j, T = V (lambda/2 (H:e) H + mu H e H).
struct StVenantKirchhoff {
  static constexpr const char* name = "st_venant_kirchhoff";
  static constexpr int participants = 4;
  static constexpr std::array parameters{"lambda", "mu",  "V",   "H00", "H01", "H02", "H11", "H12",
                                         "H22",    "G00", "G01", "G02", "G11", "G12", "G22"};
  static constexpr std::array dimensions{3};

  template <class T, int D, class... C>
  static std::array<Vector<T, D>, 3> forces(const Participants<T, D, 4>& p, const C&... c) {
    const auto [d, lambda, mu, volume, h, he, trace] = strain<T, D>(p, {c...});
    std::array<Vector<T, D>, 3> f;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const T heh = T(he[i][0] * h[0][j]) + T(he[i][1] * h[1][j]) + T(he[i][2] * h[2][j]);
        const T t = volume * (T(T(0.5) * lambda * trace) * h[i][j] + mu * heh);
        const Vector<T, D> part = T(-t) * d[j];
        f[i] = j == 0 ? part : Vector<T, D>(f[i] + part);
      }
    }
    return f;
  }
  template <class T, int D, class... C>
  static T energy(const Participants<T, D, 4>& p, const C&... c) {
    const auto [d, lambda, mu, volume, h, he, trace] = strain<T, D>(p, {c...});
    T square = T(0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) square = square + he[i][j] * he[j][i];
    return volume * (T(0.125) * lambda * trace * trace + T(0.25) * mu * square);
  }

  /// For Lame's constants [Pa] and the vertices at rest [m].
  static std::array<double, 15> parameters_of(double lambda, double mu,
                                              const std::array<Eigen::Vector3d, 4>& x) {
    Eigen::Matrix3d d;
    for (int i = 0; i < 3; ++i) d.col(i) = x[i] - x[3];
    const Eigen::Matrix3d g = d.transpose() * d, h = g.inverse();
    std::array<double, 15> all{lambda, mu, std::abs(d.determinant()) / 6};
    std::size_t n = 3;
    for (const auto* m : {&h, &g})
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) all[n++] = (*m)(i, j);
    return all;
  }

 private:
  template <class T>
  using Square = std::array<std::array<T, 3>, 3>;
  template <class T, int D>
  struct Strain {
    std::array<Vector<T, D>, 3> d;
    T lambda, mu, volume;
    Square<T> h, he;  // H and H e
    T trace;          // H:e
  };
  template <class T, int D>
  static Strain<T, D> strain(const Participants<T, D, 4>& p, const std::array<T, 15>& c) {
    Strain<T, D> s{{}, c[0], c[1], c[2], {}, {}, T(0.0)};
    for (int i = 0; i < 3; ++i) s.d[i] = p.position[i] - p.position[3];
    Square<T> e;
    std::size_t n = 3;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++n) {
        s.h[i][j] = s.h[j][i] = c[n];
        e[i][j] = e[j][i] = T(s.d[i].dot(s.d[j])) - c[n + 6];
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        s.he[i][j] = T(s.h[i][0] * e[0][j]) + T(s.h[i][1] * e[1][j]) + T(s.h[i][2] * e[2][j]);
    s.trace = s.he[0][0] + s.he[1][1] + s.he[2][2];
    return s;
  }
};

/// A box of cells, each cut into six tetrahedra along its diagonal (1, 1, 1) (H. W. Kuhn, IBM J. Res. Dev. 4 (1960) 518).
struct KuhnBox {
  std::vector<Eigen::Vector3d> vertices;  // (i, j, k) is number (i (n_y + 1) + j) (n_z + 1) + k
  std::vector<std::array<int, 4>> tetrahedra;
};

inline KuhnBox kuhn_box(const std::array<int, 3>& cells, const std::array<double, 3>& lengths) {
  KuhnBox box;
  const auto number = [&](const std::array<int, 3>& at) {
    return (at[0] * (cells[1] + 1) + at[1]) * (cells[2] + 1) + at[2];
  };
  std::array<int, 3> at;
  for (at[0] = 0; at[0] <= cells[0]; ++at[0])
    for (at[1] = 0; at[1] <= cells[1]; ++at[1])
      for (at[2] = 0; at[2] <= cells[2]; ++at[2]) {
        Eigen::Vector3d x;
        for (int c = 0; c < 3; ++c) x(c) = lengths[c] * at[c] / cells[c];
        box.vertices.push_back(x);
        if (at[0] == cells[0] || at[1] == cells[1] || at[2] == cells[2]) continue;
        std::array<int, 3> axes{0, 1, 2};
        do {  // a way from one end of the diagonal to the other
          std::array<int, 3> corner = at;
          std::array<int, 4> tetrahedron{number(corner)};
          for (int s = 0; s < 3; ++s) {
            ++corner[axes[s]];
            tetrahedron[s + 1] = number(corner);
          }
          box.tetrahedra.push_back(tetrahedron);
        } while (std::ranges::next_permutation(axes).found);
      }
  return box;
}

/// Such a body of Young's modulus [Pa], Poisson's ratio and density [kg/m^3]; each tetrahedron gives a quarter of its mass to
/// each of its vertices. stiffer: how many times stiffer each tetrahedron is; empty: none.
inline System<double> elastic(const KuhnBox& box, double young, double poisson, double density,
                              const std::vector<double>& stiffer = {}) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               mu = young / (2 * (1 + poisson));
  std::vector<double> mass(box.vertices.size(), 0.0);
  std::vector<std::array<double, 15>> parameters;
  for (std::size_t e = 0; e < box.tetrahedra.size(); ++e) {
    const auto& t = box.tetrahedra[e];
    const double times = stiffer.empty() ? 1.0 : stiffer[e];
    parameters.push_back(StVenantKirchhoff::parameters_of(
        times * lambda, times * mu,
        {box.vertices[t[0]], box.vertices[t[1]], box.vertices[t[2]], box.vertices[t[3]]}));
    for (const int i : t) mass[i] += density * parameters.back()[2] / 4;
  }
  System<double> system(3, mass);
  system.add<StVenantKirchhoff>(box.tetrahedra, parameters);
  return system;
}

/// At rest where it is.
inline State<double> at_rest(const KuhnBox& box) {
  State<double> state{0.0, Coordinates<double>(box.vertices.size(), 3), {}};
  for (std::size_t i = 0; i < box.vertices.size(); ++i) state.position.row(i) = box.vertices[i].transpose();
  state.velocity = Coordinates<double>::Zero(box.vertices.size(), 3);
  return state;
}

}  // namespace jetlag::testing
