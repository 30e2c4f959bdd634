// SPDX-License-Identifier: MIT
#pragma once
// Matchers for series and numbers.
//
//   EXPECT_THAT(exp(u + v), IsCloseTo(exp(u) * exp(v)))           coefficients carry their error bounds
//   EXPECT_THAT(exp(t), HasCoefficients([](int k) { ... }))       as above, against a closed form
//   EXPECT_THAT(x, IsCloseTo(y, ulps(8)))                         plain numbers: 8 ulps of the largest |y_k|
//   EXPECT_THAT(x, IsCloseTo(y, within(1e-13)))                   plain numbers: 1e-13 of the largest |y_k|
//
// A number is a series of one coefficient. Where both sides are of different types the wider one is used.

#include <gmock/gmock.h>

#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/series/jet.hpp"
#include "support/running_error.hpp"

namespace jetlag {
/// How GoogleTest shows a jet: (u_0, u_1, ...).
template <class T, int N, Singularities P>
void PrintTo(const Jet<T, N, P>& u, std::ostream* out) {
  *out << "(";
  for (int k = 0; k <= u.degree(); ++k) *out << (k > 0 ? ", " : "") << ::testing::PrintToString(u[k]);
  *out << ")";
}
}  // namespace jetlag

namespace jetlag::testing {

/// What the operands carry as RunningError.
struct CarriedError {};
/// A multiple of the unit in the last place of the largest expected coefficient.
struct Ulps {
  double count;
};
inline Ulps ulps(double count) { return {count}; }
/// A fraction of the largest expected coefficient.
struct Within {
  double fraction;
};
inline Within within(double fraction) { return {fraction}; }

namespace close_detail {

template <class S>
concept Sequence = requires(const S& s) { s[0]; };

template <class S>
std::size_t length(const S& s) {
  if constexpr (requires { s.degree(); })
    return s.degree() + 1;
  else if constexpr (requires { s.size(); })
    return static_cast<std::size_t>(s.size());
  else
    return 1;
}
template <class S>
auto coefficient(const S& s, std::size_t k) {
  if constexpr (Sequence<S>)
    return s[static_cast<int>(k)];
  else
    return s;
}
template <class X>
auto value(const X& x) {
  if constexpr (carries_error<X>)
    return x.value;
  else
    return x;
}
template <class X>
auto error(const X& x) {
  if constexpr (carries_error<X>)
    return x.error;
  else
    return X(0);
}

template <class A, class E, class Tolerance>
bool close(const A& actual, const E& expected, Tolerance tolerance,
           ::testing::MatchResultListener* listener) {
  using Own = decltype(value(coefficient(actual, 0)));
  using Wide = std::decay_t<decltype(value(coefficient(actual, 0)) + value(coefficient(expected, 0)))>;
  const auto size = [](const Wide& x) { return x < Wide(0) ? Wide(-x) : x; };
  const Wide eps(std::numeric_limits<Own>::epsilon());
  if (length(actual) != length(expected)) {
    *listener << length(actual) << " coefficients instead of " << length(expected);
    return false;
  }
  Wide largest(0);
  for (std::size_t k = 0; k < length(expected); ++k) {
    const Wide e = size(Wide(value(coefficient(expected, k))));
    if (e > largest) largest = e;
  }
  for (std::size_t k = 0; k < length(actual); ++k) {
    const Wide a(value(coefficient(actual, k))), e(value(coefficient(expected, k)));
    Wide allowed;
    if constexpr (std::is_same_v<Tolerance, Ulps>)
      allowed = Wide(tolerance.count) * eps * largest;
    else if constexpr (std::is_same_v<Tolerance, Within>)
      allowed = Wide(tolerance.fraction) * largest;
    else {
      allowed = Wide(error(coefficient(actual, k))) + Wide(error(coefficient(expected, k)));
      if (!(allowed <= Wide(1 << 20) * eps * largest)) {
        *listener << "coefficient " << k << " carries an error of " << allowed << ": it proves nothing";
        return false;
      }
    }
    if (!(size(Wide(a - e)) <= allowed)) {  // also when either is NaN
      *listener << "coefficient " << k << " is " << a << " instead of " << e << ", off by " << Wide(a - e)
                << " where " << allowed << " is allowed";
      return false;
    }
  }
  return true;
}

template <class E, class Tolerance>
class CloseMatcher {
 public:
  using is_gtest_matcher = void;
  CloseMatcher(E expected, Tolerance tolerance) : expected_(std::move(expected)), tolerance_(tolerance) {}
  template <class A>
  bool MatchAndExplain(const A& actual, ::testing::MatchResultListener* listener) const {
    if constexpr (!Sequence<E> && std::invocable<const E&, int>) {
      using Coefficient = std::decay_t<std::invoke_result_t<const E&, int>>;
      std::vector<Coefficient> expected;
      for (std::size_t k = 0; k < length(actual); ++k) expected.push_back(expected_(static_cast<int>(k)));
      return close(actual, expected, tolerance_, listener);
    } else {
      return close(actual, expected_, tolerance_, listener);
    }
  }
  void DescribeTo(std::ostream* out) const { *out << "has the expected coefficients"; }
  void DescribeNegationTo(std::ostream* out) const { *out << "differs from the expected coefficients"; }

 private:
  E expected_;
  Tolerance tolerance_;
};

}  // namespace close_detail

/// Equal to a series, a container or a number, within a tolerance.
template <class E, class Tolerance = CarriedError>
auto IsCloseTo(const E& expected, Tolerance tolerance = {}) {
  return close_detail::CloseMatcher<E, Tolerance>(expected, tolerance);
}

/// Coefficient k is expected(k). The matcher knows only the type of a coefficient: one for each lambda, with all that
/// GoogleMock makes of it, would be most of what a file of such tests costs to compile.
template <std::invocable<int> F, class Tolerance = CarriedError>
auto HasCoefficients(F expected, Tolerance tolerance = {}) {
  using Coefficient = std::decay_t<std::invoke_result_t<const F&, int>>;
  return close_detail::CloseMatcher<std::function<Coefficient(int)>, Tolerance>(std::move(expected),
                                                                                tolerance);
}

}  // namespace jetlag::testing
