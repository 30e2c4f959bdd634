// SPDX-License-Identifier: MIT
#pragma once
// Eigen's small column vectors of scalars that are recurrences (series/online/online.hpp): what laws do with positions and forces,
// without the layers of expressions, which compilers do not see through in so long a function.

#include <Eigen/Core>
#include <utility>

#include "jetlag/series/eigen.hpp"
#include "jetlag/series/online/online.hpp"

namespace Eigen {

template <int D>
class Matrix<jetlag::Online, D, 1, 0, D, 1> {
  template <class F>
  static void for_each_component(const F& f) {
    [&]<int... c>(std::integer_sequence<int, c...>) {
      (f(std::integral_constant<int, c>()), ...);
    }(std::make_integer_sequence<int, D>());
  }

 public:
  using Scalar = jetlag::Online;

  Matrix() = default;
  static Matrix Constant(const Scalar& c) {
    return of([&](int) { return c; });
  }
  static Matrix Zero() { return Constant(Scalar(0.0)); }

  Scalar& operator[](int c) { return component_[c]; }
  const Scalar& operator[](int c) const { return component_[c]; }
  Scalar& operator()(int c) { return component_[c]; }
  const Scalar& operator()(int c) const { return component_[c]; }
  static constexpr int size() { return D; }

  Scalar dot(const Matrix& v) const {
    Scalar sum = component_[0] * v[0];
    for_each_component([&](auto c) {
      if constexpr (c > 0) sum += component_[c] * v[c];
    });
    return sum;
  }
  Scalar squaredNorm() const { return dot(*this); }
  Scalar norm() const { return sqrt(squaredNorm()); }
  Matrix cross(const Matrix& v) const
    requires(D == 3)
  {
    return of([&](auto c) {
      constexpr int a = (c + 1) % 3, b = (c + 2) % 3;
      return component_[a] * v[b] - component_[b] * v[a];
    });
  }

  friend Matrix operator+(const Matrix& u, const Matrix& v) {
    return of([&](auto c) { return u[c] + v[c]; });
  }
  friend Matrix operator-(const Matrix& u, const Matrix& v) {
    return of([&](auto c) { return u[c] - v[c]; });
  }
  friend Matrix operator-(const Matrix& u) {
    return of([&](auto c) { return -u[c]; });
  }
  friend Matrix operator*(const Scalar& s, const Matrix& u) {
    return of([&](auto c) { return s * u[c]; });
  }
  friend Matrix operator*(const Matrix& u, const Scalar& s) { return s * u; }
  friend Matrix operator/(const Matrix& u, const Scalar& s) {
    return of([&](auto c) { return u[c] / s; });
  }
  Matrix& operator+=(const Matrix& v) { return *this = *this + v; }
  Matrix& operator-=(const Matrix& v) { return *this = *this - v; }
  Matrix& operator*=(const Scalar& s) { return *this = s * *this; }

 private:
  template <class F>
  static Matrix of(const F& f) {
    Matrix v;
    for_each_component([&](auto c) { v.component_[c] = f(c); });
    return v;
  }

  Scalar component_[D];
};

}  // namespace Eigen
