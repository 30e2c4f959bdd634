// SPDX-License-Identifier: MIT
#pragma once
// Jets inside Eigen: Eigen::Matrix<Jet<double, 8>, 3, 1> has dot, norm, cross and products.

#include <Eigen/Geometry>

#include "jetlag/series/elementary.hpp"

namespace Eigen {
template <class T, int N, jetlag::Singularities P>
struct NumTraits<jetlag::Jet<T, N, P>> : GenericNumTraits<jetlag::Jet<T, N, P>> {
  using Real = jetlag::Jet<T, N, P>;
  using NonInteger = jetlag::Jet<T, N, P>;
  using Nested = jetlag::Jet<T, N, P>;
  using Literal = T;
  static constexpr bool is_dynamic = N == jetlag::Dynamic;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = is_dynamic ? int(HugeCost) : N + 1,
    AddCost = is_dynamic ? int(HugeCost) : N + 1,
    MulCost = is_dynamic ? int(HugeCost) : (N + 1) * (N + 2) / 2
  };
};

// Mixed products of jets and plain numbers.
template <class T, int N, jetlag::Singularities P, jetlag::ScalarOf<jetlag::Jet<T, N, P>> X, class Op>
struct ScalarBinaryOpTraits<jetlag::Jet<T, N, P>, X, Op> {
  using ReturnType = jetlag::Jet<T, N, P>;
};
template <class T, int N, jetlag::Singularities P, jetlag::ScalarOf<jetlag::Jet<T, N, P>> X, class Op>
struct ScalarBinaryOpTraits<X, jetlag::Jet<T, N, P>, Op> {
  using ReturnType = jetlag::Jet<T, N, P>;
};
}  // namespace Eigen
