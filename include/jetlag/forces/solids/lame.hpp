// SPDX-License-Identifier: MIT
#pragma once
// The two constants of an isotropic elastic material.

#include <stdexcept>

#include "jetlag/forces/solids/simplex.hpp"

namespace jetlag {

/// Lame's constants [Pa].
template <class T = double>
struct Lame {
  T lambda, mu;
};

/// lambda = E nu / ((1 + nu)(1 - 2 nu)),   mu = E / (2 (1 + nu)).         Source: linear elasticity.
/// young E [Pa], > 0; poisson nu [1], in (-1, 0.5). Throws std::invalid_argument for others.
template <class T = double>
Lame<T> lame(const T& young, const T& poisson) {
  if (!(young > T(0)))
    throw std::invalid_argument("young must be > 0, got " + detail::text_of(young) + " Pa");
  if (!(poisson > T(-1)) || !(T(2) * poisson < T(1)))
    throw std::invalid_argument(
        "poisson must be > -1 and < 0.5, got " + detail::text_of(poisson) +
        ": 0.5 is incompressible, where the stiffness is infinite; 0.499 is the most that is worth trying");
  return {young * poisson / ((T(1) + poisson) * (T(1) - T(2) * poisson)), young / (T(2) * (T(1) + poisson))};
}

/// Of a thin sheet without stress across it: lambda -> 2 lambda mu / (lambda + 2 mu). Exact for `plane_stvk`, whose law is
/// else that of a slice that keeps its thickness (plane strain). Of viscosities in proportion to the elastic constants it is
/// exact too. Both zero stay zero.
template <class T>
Lame<T> plane_stress(const Lame<T>& of) {
  const T whole = of.lambda + T(2) * of.mu;
  return {whole == T(0) ? T(0) : T(2) * of.lambda * of.mu / whole, of.mu};
}

}  // namespace jetlag
