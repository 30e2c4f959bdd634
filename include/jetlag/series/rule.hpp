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
//
// Who applies rules to a kind of number writes the function templates lift<Rule, Number>(u...) and lift_coupled beside it,
// and argument-dependent look-up finds them: jets (series/lift.hpp) and recorded numbers (tape/recording.hpp).

#include <array>
#include <concepts>
#include <cstddef>

#include "jetlag/series/complex.hpp"

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

/// Partial sums that a sum of products is spread over, so that one addition need not wait for the last. One is enough
/// where T itself is several registers wide.
template <class T>
inline constexpr int partial_sums = 1;

/// Whether sums over T are straight code: k is known when they are compiled (series/online/unrolled.hpp). What decides their time is
/// how long the newest terms wait, those at both ends of a convolution: they are added last.
template <class T>
inline constexpr bool is_unrolled = false;

/// a / b of what is the same b at every order: T may take the reciprocal, once for all.
template <class T>
T over(const T& a, const T& b) {
  return a / b;
}

/// sum_{i=0..n-1} a(i) b(i), n >= 1, from the middle outwards; straight code where n is known.
template <class T, class A, class B>
T sum_from_the_middle(int n, const A& a, const B& b) {
  const int middle = (n - 1) / 2;
  T sum = a(middle) * b(middle);
  const auto add_pair = [&](int d) {
    if (d <= middle) sum = multiply_add<T>(a(middle - d), b(middle - d), sum);
    sum = multiply_add<T>(a(middle + d), b(middle + d), sum);
  };
  if (__builtin_constant_p(n)) {
#pragma GCC unroll 64
    for (int d = 1; d <= n / 2; ++d) add_pair(d);
  } else {
    for (int d = 1; d <= n / 2; ++d) add_pair(d);
  }
  return sum;
}

/// sum_{i=0..n-1} a(i) b(i), n >= 1: term i goes to partial sum i modulo partial_sums<T>.
template <class T, class A, class B>
T sum_of_products(int n, const A& a, const B& b) {
  constexpr int width = partial_sums<T>;
  if constexpr (is_unrolled<T>) {
    return sum_from_the_middle<T>(n, a, b);
  } else if constexpr (width == 1) {
    T sum = a(0) * b(0);
    for (int i = 1; i < n; ++i) sum = multiply_add<T>(a(i), b(i), sum);
    return sum;
  } else {
    T part[width];
    for (int c = 0; c < width; ++c) part[c] = c < n ? T(a(c) * b(c)) : T(0);
    int i = width;
    for (; i + width <= n; i += width)
      for (int c = 0; c < width; ++c) part[c] = multiply_add<T>(a(i + c), b(i + c), part[c]);
    for (int c = 0; c < width - 1; ++c)
      if (i + c < n) part[c] = multiply_add<T>(a(i + c), b(i + c), part[c]);
    for (int half = width / 2; half > 0; half /= 2)
      for (int c = 0; c < half; ++c) part[c] = part[c] + part[c + half];
    return part[0];
  }
}

/// sum_{j=first..last} u_j v_{k-j}, summed in the order of j; 0 when the range is empty.
template <class U, class V>
auto convolution(int k, int first, int last, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  if (first > last) return T(0);
  return sum_of_products<T>(
      last - first + 1, [&](int i) -> decltype(auto) { return u[first + i]; },
      [&](int i) -> decltype(auto) { return v[k - first - i]; });
}

/// sum_{j=first..last} j u_j v_{k-j}; 0 when the range is empty.
template <class U, class V>
auto weighted_convolution(int k, int first, int last, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  if (first > last) return T(0);
  return sum_of_products<T>(
      last - first + 1, [&](int i) { return T((first + i) * u[first + i]); },
      [&](int i) -> decltype(auto) { return v[k - first - i]; });
}

/// (sum_{j=1..k} j u_j v_{k-j}) / k, k >= 1: coefficient k of the integral of u' v.
template <class U, class V>
auto integral_of_product(int k, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  if constexpr (is_unrolled<T>)  // v_{k-1} is the newest
    return multiply_add<T>(u[1] / k, v[k - 1], weighted_convolution(k, 2, k, u, v) / k);
  else
    return weighted_convolution(k, 1, k, u, v) / k;
}

/// (sum_{i=0..n-1} a(i) b(i)) / (k c), n >= 1: k is an order, c the same at every order, the last term the newest.
template <class T, class A, class B>
T sum_of_products_over(int n, const A& a, const B& b, int k, const T& c) {
  if constexpr (is_unrolled<T>) {
    const T r = (T(1.0) / c) / k;
    const T newest = a(n - 1) * r;
    if (n == 1) return newest * b(0);
    return multiply_add<T>(newest, b(n - 1), r * sum_from_the_middle<T>(n - 1, a, b));
  } else {
    return sum_of_products<T>(n, a, b) / (k * c);
  }
}

/// sum_{j=first..k-first} u_j u_{k-j}, each pair of equal terms computed once, the outermost last; 0 when the range is
/// empty.
template <class U>
auto symmetric_convolution(int k, int first, const U& u) {
  using T = std::decay_t<decltype(u[0] * u[0])>;
  const int last = (k + 1) / 2 - 1;  // the largest j with j < k - j
  T sum = convolution(k, k - last, k - first, u, u);
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

// ---- two orders at once ----------------------------------------------------------------------------------
//
// Coefficients k and k + 1 read nearly the same coefficients. Computed together they load each of them once, where
// loading is what takes the time. A rule may have a second member for this,
//
//     static auto two_coefficients(int k, const auto& u, const auto& v);    // {v_k, v_{k+1}} for k >= two_from
//     static constexpr int two_from = 0;
//
// Invariant, tested as well: the same bits as `coefficient`, one after the other.

template <class T>
using Two = std::array<T, 2>;

/// { sum_{i=0..n-1} a(i) b(i),  head + sum_{i=0..n-1} a(i+1) b(i) };   head may be null.
template <class T, class A, class B>
Two<T> two_sums_of_products(int n, const A& a, const B& b, const T* head = nullptr) {
  if (n < 1) return {T(0), head ? *head : T(0)};
  T next = a(1), common = b(0);
  T first = a(0) * common, second = head ? multiply_add<T>(next, common, *head) : T(next * common);
  for (int i = 1; i < n; ++i) {
    const T here = next;
    next = a(i + 1);
    common = b(i);
    first = multiply_add<T>(here, common, first);
    second = multiply_add<T>(next, common, second);
  }
  return {first, second};
}

/// Two orders of the product: convolution(k, 0, k, u, v) and convolution(k + 1, 0, k + 1, u, v).
template <class U, class V>
auto two_convolutions(int k, const U& u, const V& v) {
  using T = std::decay_t<decltype(u[0] * v[0])>;
  const T head = u[0] * v[k + 1];
  return two_sums_of_products<T>(
      k + 1, [&](int i) -> decltype(auto) { return u[i]; }, [&](int i) -> decltype(auto) { return v[k - i]; },
      &head);
}

/// Two orders of the square: symmetric_convolution(k, 0, u) and symmetric_convolution(k + 1, 0, u).
template <class U>
auto two_symmetric_convolutions(int k, const U& u) {
  using T = std::decay_t<decltype(u[0] * u[0])>;
  const int half = k / 2, last = (k + 1) / 2 - 1;
  const bool even = k % 2 == 0;
  T head(0);
  if (even) head = u[half + 1] * u[half];
  Two<T> sums = two_sums_of_products<T>(
      last + 1, [&](int i) -> decltype(auto) { return u[k - last + i]; },
      [&](int i) -> decltype(auto) { return u[last - i]; }, even ? &head : nullptr);
  for (T& sum : sums) sum = sum + sum;
  T& of_even_order = sums[even ? 0 : 1];
  const T& middle = u[(k + 1) / 2];
  of_even_order = k == 0 ? T(middle * middle) : multiply_add<T>(middle, middle, of_even_order);
  return sums;
}

}  // namespace jetlag
