// SPDX-License-Identifier: MIT
#pragma once
// The register of rules: to add a function, write its file and add its line here. Tapes, SIMD kernels,
// the table of functions and the laws of tests/series run over this list.
//
// A jet needs of its number type only the functions that are called; a tape needs all of them: those of <cmath> that the
// rules name, < and <=. For Boost.Multiprecision include <boost/math/special_functions/erf.hpp>.

#include <type_traits>

#include "jetlag/series/arithmetic.hpp"
#include "jetlag/series/conditions.hpp"
#include "jetlag/series/functions/cbrt.hpp"
#include "jetlag/series/functions/erf.hpp"
#include "jetlag/series/functions/exp.hpp"
#include "jetlag/series/functions/hyperbolic.hpp"
#include "jetlag/series/functions/inverse_hyperbolic.hpp"
#include "jetlag/series/functions/inverse_trigonometric.hpp"
#include "jetlag/series/functions/log.hpp"
#include "jetlag/series/functions/polar.hpp"
#include "jetlag/series/functions/power.hpp"
#include "jetlag/series/functions/sign.hpp"
#include "jetlag/series/functions/sin_cos.hpp"
#include "jetlag/series/functions/sqrt.hpp"
#include "jetlag/series/functions/stretch_invariants.hpp"
#include "jetlag/series/functions/tan.hpp"
#include "jetlag/series/sums.hpp"

namespace jetlag {

template <Rule... R>
struct RuleList {
  static constexpr int size = sizeof...(R);
};

using Rules = RuleList<Embed,                                                   //
                       Add,                                                     //
                       Subtract,                                                //
                       Negate,                                                  //
                       Offset,                                                  //
                       Scale,                                                   //
                       Multiply,                                                //
                       Square,                                                  //
                       Divide,                                                  //
                       DivideByConstant,                                        //
                       Reciprocal,                                              //
                       Sum<3>, Sum<4>,                                          //
                       SquaredNorm<2>, SquaredNorm<3>, Dot<2>, Dot<3>,          //
                       DifferenceOfProducts,                                    //
                       LinearCombination<1>, LinearCombination<2>,              //
                       LinearCombination<3>, LinearCombination<5>,              //
                       Sqrt, Cbrt,                                              //
                       Power, PowerOfSeries,                                    //
                       Exp, Expm1,                                              //
                       Log, Log1p, Log2, Log10,                                 //
                       Sin, Cos,                                                //
                       Tan, SecantSquared,                                      //
                       Sinh, Cosh,                                              //
                       Tanh, HyperbolicSecantSquared,                           //
                       OneMinusSquare, Asin, Acos, Atan,                        //
                       Asinh, Acosh, Atanh,                                     //
                       Length, ScaledSumOfSquares, ScaledSquare, RootOfScaled,  //
                       Atan2, Atan2OfConstant, Atan2OverConstant,               //
                       FirstStretchInvariant, SecondStretchInvariant,           //
                       Gaussian, Erf, Erfc,                                     //
                       Sign, Abs, BySign,                                       //
                       Less, LessOrEqual, And, Or, Not, Select>;

namespace detail {
template <class R, class... Rs>
consteval int position_in(RuleList<Rs...>) {
  constexpr bool here[] = {std::is_same_v<R, Rs>...};
  for (int i = 0; i < static_cast<int>(sizeof...(Rs)); ++i)
    if (here[i]) return i;
  return -1;
}
}  // namespace detail

/// Position of a rule in the register.
template <Rule R>
inline constexpr int rule_id = [] {
  constexpr int id = detail::position_in<R>(Rules{});
  static_assert(id >= 0, "add the rule to the register in series/functions.hpp");
  return id;
}();

}  // namespace jetlag
