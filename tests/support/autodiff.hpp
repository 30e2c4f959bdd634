// SPDX-License-Identifier: MIT
#pragma once
// Jets against Boost.Math's automatic differentiation, an implementation by other means (nested polynomials
// in x - x_0, composed by Horner's rule, no recurrences), in 50 digits.

#include <gtest/gtest.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/math/special_functions/factorials.hpp>
#include <functional>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing {

constexpr int autodiff_degree = 8;
using JetOfAutodiff = Jet<RunningError<double>, autodiff_degree>;
using BoostsNumber =
    decltype(boost::math::differentiation::make_fvar<Digits50, autodiff_degree>(Digits50(0)));

/// A function of a jet, and the same as Boost has it. Without their types: what compares them is compiled once.
using OfJet = std::function<JetOfAutodiff(const JetOfAutodiff&)>;
using OfBoost = std::function<BoostsNumber(const BoostsNumber&)>;

/// f at x + t: the jet against derivatives over factorials. g is f as Boost has it.
inline void expect_same_derivatives(const OfJet& f, const OfBoost& g, double x) {
  const auto truth = g(boost::math::differentiation::make_fvar<Digits50, autodiff_degree>(Digits50(x)));
  EXPECT_THAT(f(JetOfAutodiff::variable(x)), HasCoefficients([&](int k) {
                return Digits50(truth.derivative(k) / boost::math::factorial<Digits50>(k));
              }))
      << "at " << x;
}
template <class F>
void expect_same_derivatives(const F& f, double x) {
  expect_same_derivatives(f, f, x);
}

}  // namespace jetlag::testing
