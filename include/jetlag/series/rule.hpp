// SPDX-License-Identifier: MIT
#pragma once
// What a rule is: coefficient k of v = f(u, ...) from coefficients <= k of u and < k of v.
//
// A rule is a struct with three static members:
//
//   struct Exp {
//     static constexpr const char* name = "exp";
//     static constexpr std::array reads{Reads::history, Reads::history};    // u, and v itself
//     static auto coefficient(int k, const auto& u, const auto& v);
//   };
//
// `reads` has one entry per operand and a last one for the result itself. Invariants, tested for every
// rule of the register (functions.hpp):
//   - `coefficient(k, ...)` reads an operand as declared, and never a coefficient of the result >= k;
//   - it does not depend on the degree that is wanted in the end, so a series can be resumed.
//
// The same rule serves a Jet (a loop over k), a node of a tape (one more k each time the scene grows
// by one order) and a block of SIMD lanes: u[j] is a number of any type with + - * /.

#include <array>
#include <concepts>
#include <cstddef>

namespace jetlag {

/// How much of an operand's series a rule reads to compute coefficient k.
enum class Reads {
  nothing,   // none of it
  constant,  // coefficient 0; the operand has no other
  first,     // coefficient 0, at every order (a condition)
  newest,    // coefficient k
  history,   // any coefficient <= k (of the result itself: < k)
};

template <class R>
concept Rule = requires {
  { R::name } -> std::convertible_to<const char*>;
  R::reads.size();
};

/// Number of operands of a rule.
template <Rule R>
inline constexpr int arity = static_cast<int>(R::reads.size()) - 1;

/// a b + c, rounded once where the number type says how (SIMD lanes with FMA), twice elsewhere.
template <class T>
T multiply_add(const T& a, const T& b, const T& c) {
  return a * b + c;
}

/// sum_{j=first..last} u_j v_{k-j}, summed in the order of j; 0 when the range is empty.
template <class U, class V>
auto convolution(int k, int first, int last, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  if (first > last) return T(0);
  T sum = u[first] * v[k - first];
  for (int j = first + 1; j <= last; ++j) sum = multiply_add<T>(u[j], v[k - j], sum);
  return sum;
}

/// sum_{j=first..last} j u_j v_{k-j}; 0 when the range is empty.
template <class U, class V>
auto weighted_convolution(int k, int first, int last, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  if (first > last) return T(0);
  T sum = (first * u[first]) * v[k - first];
  for (int j = first + 1; j <= last; ++j) sum = multiply_add<T>(j * u[j], v[k - j], sum);
  return sum;
}

/// sum_{j=first..k-first} u_j u_{k-j}, each pair of equal terms computed once; 0 when the range is empty.
template <class U>
auto symmetric_convolution(int k, int first, const U& u) {
  using T = std::decay_t<decltype(u[0] * u[0])>;
  const int last = (k + 1) / 2 - 1;  // the largest j with j < k - j
  T sum = convolution(k, first, last, u, u);
  if (first <= last) sum = sum + sum;
  if (k % 2 == 0 && first <= k / 2) sum = multiply_add<T>(u[k / 2], u[k / 2], sum);
  return sum;
}

/// sum_{j=first..k-first} (r u_j) u_{k-j} with a number r, each pair computed once; 0 when the range is empty.
template <class T, class U>
T scaled_symmetric_convolution(int k, int first, const T& r, const U& u) {
  T sum(0);
  for (int j = first; j < k - j; ++j) sum = multiply_add<T>(r * u[j], u[k - j], sum);
  sum = sum + sum;
  if (k % 2 == 0 && first <= k / 2) sum = multiply_add<T>(r * u[k / 2], u[k / 2], sum);
  return sum;
}

}  // namespace jetlag
