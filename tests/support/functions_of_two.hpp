// SPDX-License-Identifier: MIT
#pragma once
// Functions of two numbers, jets or recorded values, which have all rules of the register between them.

#include <tuple>
#include <utility>

#include "jetlag/series/comparisons.hpp"

namespace jetlag::testing {

template <class F>
struct Named {
  const char* name;
  F f;
};
template <class F>
Named(const char*, F) -> Named<F>;

/// Of stretches x, y, 1.
template <class T>
std::pair<T, T> stretch_invariants_of_diagonal(const T& x, const T& y) {
  const T xx = pow(x, 2), yy = pow(y, 2);  // a tape knows squares, and has its own order of three terms
  return stretch_invariants(T(xx + yy + 1.0), T(xx * (1.0 + yy) + yy), T(x * y));
}

/// Functions of x and y, 1/8 < x_0 < 7/8 < 1 < y_0 < 2; further out each leaves its range somewhere.
constexpr auto smooth_functions = std::tuple{
    Named{"square root", [](const auto& x, const auto&) { return sqrt(x); }},
    Named{"cbrt", [](const auto& x, const auto&) { return cbrt(x); }},
    Named{"real power", [](const auto& x, const auto&) { return pow(x, 1.5); }},
    Named{"negative power", [](const auto& x, const auto&) { return pow(x, -2); }},
    Named{"power of a number", [](const auto& x, const auto&) { return pow(2.5, x); }},
    Named{"power", [](const auto& x, const auto& y) { return pow(x, y); }},
    Named{"exp", [](const auto& x, const auto&) { return exp(x); }},
    Named{"expm1", [](const auto& x, const auto&) { return expm1(x); }},
    Named{"log", [](const auto& x, const auto&) { return log(x); }},
    Named{"log1p", [](const auto& x, const auto&) { return log1p(x); }},
    Named{"log2", [](const auto& x, const auto&) { return log2(x); }},
    Named{"log10", [](const auto& x, const auto&) { return log10(x); }},
    Named{"sin", [](const auto& x, const auto&) { return sin(x); }},
    Named{"cos", [](const auto& x, const auto&) { return cos(x); }},
    Named{"tan", [](const auto& x, const auto&) { return tan(x); }},
    Named{"asin", [](const auto& x, const auto&) { return asin(x); }},
    Named{"acos", [](const auto& x, const auto&) { return acos(x); }},
    Named{"atan", [](const auto& x, const auto&) { return atan(x); }},
    Named{"sinh", [](const auto& x, const auto&) { return sinh(x); }},
    Named{"cosh", [](const auto& x, const auto&) { return cosh(x); }},
    Named{"tanh", [](const auto& x, const auto&) { return tanh(x); }},
    Named{"asinh", [](const auto& x, const auto&) { return asinh(x); }},
    Named{"acosh", [](const auto&, const auto& y) { return acosh(y); }},
    Named{"atanh", [](const auto& x, const auto&) { return atanh(x); }},
    Named{"erf", [](const auto& x, const auto&) { return erf(x); }},
    Named{"erfc", [](const auto& x, const auto&) { return erfc(x); }},
    Named{"hypot", [](const auto& x, const auto& y) { return hypot(x, y); }},
    Named{"hypot with a number", [](const auto& x, const auto&) { return hypot(x, 3.0); }},
    Named{"atan2", [](const auto& x, const auto& y) { return atan2(x, -y); }},
    Named{"atan2 over a number", [](const auto& x, const auto&) { return atan2(x, 2.0); }},
    Named{"atan2 of a number", [](const auto& x, const auto&) { return atan2(-2.0, x); }},
    Named{"first stretch invariant",
          [](const auto& x, const auto& y) { return stretch_invariants_of_diagonal(x, y).first; }},
    Named{"second stretch invariant",
          [](const auto& x, const auto& y) { return stretch_invariants_of_diagonal(x, y).second; }}};
constexpr auto choices = std::tuple{
    Named{"abs", [](const auto& x, const auto& y) { return abs(x - y); }},
    Named{"min", [](const auto& x, const auto& y) { return min(x * y, 0.5); }},
    Named{"max", [](const auto& x, const auto& y) { return max(x * y, x + 0.25); }},
    Named{"select", [](const auto& x, const auto& y) { return select(x < 0.5, sqrt(x), y); }},
    Named{"all together",
          [](const auto& x, const auto& y) {
            // factors in the order of their names: a tape multiplies the older by the newer
            const auto a = asin(x), b = erf(y), c = atan2(log1p(x), acosh(y)), d = cbrt(hypot(x, y));
            return tan(a * b) + c * d - select(x * y < 0.5, tanh(y), pow(y, x)) / (1.0 + expm1(max(x, 0.5)));
          }},
};
constexpr auto functions = std::tuple_cat(smooth_functions, choices);

/// action(name, f) for each function.
template <class Action>
void for_each_function(Action action) {
  std::apply([&](const auto&... named) { (action(named.name, named.f), ...); }, functions);
}

}  // namespace jetlag::testing
