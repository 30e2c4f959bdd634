// SPDX-License-Identifier: MIT
#pragma once
// The error of the coefficients of v = f(u), in units that allow for what no method can avoid:
//
//     error of coefficient k  =  |computed v_k - v_k|  /  (2^-52 max(|v_k|, C_k)),         k = 0, ..., 20.
//
// v_k is true to 75 digits for the very doubles u_j that are given. C_k is the condition of v_k: how far v_k moves, to
// first order, if every coefficient u_j with j >= 1 moves by its own size and nothing cancels. An error of 1 is thus
// what one unit in the last place of u_1, u_2, ... does to v_k. u_0 is taken as exact: coefficient 0 is held to its own
// last place (half a unit is right rounding), and so is coefficient 1 of functions of one variable.
//
// C_k is made of the function and the point alone, not of the formulas that the library happens to use: a formula that
// cancels shows. It is the sum of the absolute values of all terms of Faa di Bruno's formula
// v(t) = sum_m f_m (u(t) - u_0)^m, each counted once for every factor u_j in it; S_k is the same sum, counted once:
//
//     S(t) = sum_m a_m (sum_{j>=1} |u_j| t^j)^m,   C(t) = sum_m m a_m (...)^m,      f_m: coefficient m of f(u_0 + t),
//     a_0 = |f_0|,  a_1 = |f_1|,  a_m = max(|f_m|, sqrt(|f_{m-i} f_{m+i}|); i <= 5, m/2).
//
// The square root matters where the f_m themselves oscillate, as for atan (like cos(m theta)) or erf (Hermite
// polynomials): f_m may then vanish between its neighbours, and a_m is the amplitude there.
//
// For functions of two series S and C are made of the same pieces (terms.hpp):
//     u v, u / v      |u|(t) |v|(t), counted once; |u|(t) times those of 1/v
//     u^v             |p_0| exp(the S of v log u without its coefficient 0)
//     hypot, atan2    from sqrt and log of the complex z = x + i y: with z~ = sum_{j>=1} (|x_j| + |y_j|) t^j / |z_0|,
//                     S = |z_0| (2 - sqrt(1 - z~))^2 and -log(1 - z~); coefficient 1 from the gradient at (x_0, y_0)
//     u + v, |u|, min, max, select     0: they add once or choose
//
// Coefficients with C_k above 2^1000 or S_k below 2^-970 are left out: there is overflow, or not all digits exist.

#include <functional>
#include <string>

#include "accuracy/functions.hpp"

namespace jetlag::accuracy {

struct Where {
  double error = 0;
  std::string point;  // "0.25, k = 17, random": u_0, coefficient, kind of series
};

struct Measured {
  Where first;           // coefficient 0
  Where later;           // coefficients 1 to 20
  double strict = 0;     // the same, with S_k for C_k
  int coefficients = 0;  // how many have been compared
};

/// Calls f(operands, kind of series) at all corners of the domains and that many draws, with six kinds of series at
/// each. The same points every time.
void for_each_point(const Function& function, int draws,
                    const std::function<void(const Operands&, const char*)>& f);

/// The largest errors over these points.
Measured measure(const Function& function, int draws);

}  // namespace jetlag::accuracy
