// SPDX-License-Identifier: MIT
#pragma once
// Jets inside Eigen: Eigen::Matrix<Jet<double, 8>, 3, 1> has dot, norm, cross and products.

#include <Eigen/Geometry>

#include "jetlag/series/elementary.hpp"

namespace Eigen {
template <class T, int N>
struct NumTraits<jetlag::Jet<T, N>> : GenericNumTraits<jetlag::Jet<T, N>> {
  using Real = jetlag::Jet<T, N>;
  using NonInteger = jetlag::Jet<T, N>;
  using Nested = jetlag::Jet<T, N>;
  using Literal = T;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N + 1,
    AddCost = N + 1,
    MulCost = (N + 1) * (N + 2) / 2
  };
};

// Mixed products of jets and plain numbers.
template <class T, int N, class Op>
struct ScalarBinaryOpTraits<jetlag::Jet<T, N>, T, Op> {
  using ReturnType = jetlag::Jet<T, N>;
};
template <class T, int N, class Op>
struct ScalarBinaryOpTraits<T, jetlag::Jet<T, N>, Op> {
  using ReturnType = jetlag::Jet<T, N>;
};
}  // namespace Eigen
