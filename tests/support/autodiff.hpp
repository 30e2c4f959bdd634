// SPDX-License-Identifier: MIT
#pragma once
// Jets against Boost.Math's automatic differentiation, an implementation by other means (nested polynomials
// in x - x_0, composed by Horner's rule, no recurrences), in 50 digits.

#include <gtest/gtest.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/math/special_functions/factorials.hpp>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing {

/// f at x + t: the jet against derivatives over factorials. g is f as Boost has it.
template <class F, class G>
void expect_same_derivatives(F f, G g, double x) {
  constexpr int degree = 8;
  using J = Jet<RunningError<double>, degree>;
  const auto truth = g(boost::math::differentiation::make_fvar<Digits50, degree>(Digits50(x)));
  EXPECT_THAT(f(J::variable(x)), HasCoefficients([&](int k) {
                return Digits50(truth.derivative(k) / boost::math::factorial<Digits50>(k));
              }))
      << "at " << x;
}
template <class F>
void expect_same_derivatives(F f, double x) {
  expect_same_derivatives(f, f, x);
}

}  // namespace jetlag::testing
