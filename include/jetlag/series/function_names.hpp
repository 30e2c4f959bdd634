// SPDX-License-Identifier: MIT
#pragma once
// The functions of <cmath> that rules call at order 0, but for sqrt and pow, for number types that forward them to those of doubles.

/// f(name) for each function of one number.
#define JETLAG_FUNCTIONS_OF_ONE(f)                                                                      \
  f(cbrt) f(exp) f(expm1) f(log) f(log1p) f(log2) f(log10) f(sin) f(cos) f(tan) f(asin) f(acos) f(atan) \
      f(sinh) f(cosh) f(tanh) f(asinh) f(acosh) f(atanh) f(erf) f(erfc)
