// SPDX-License-Identifier: MIT
#pragma once
// Sums and products of floating-point numbers together with their rounding error, which is itself a number.

#include <cmath>
#include <concepts>
#include <limits>

namespace jetlag {

/// Binary numbers that are rounded to nearest: those of the language, and Boost's cpp_bin_float.
template <class T>
concept BinaryNumber = std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_integer &&
                       std::numeric_limits<T>::radix == 2;

/// The unevaluated sum high + low: about twice the digits of T.
template <BinaryNumber T>
struct TwoPart {
  T high{};
  T low{};
  /// The sum, rounded once.
  T value() const { return high + low; }
};

/// a + b = high + low exactly, high = a + b rounded.         Source: Knuth, TAOCP 2, 4.2.2, theorem B: six additions.
/// Range: no overflow.
template <BinaryNumber T>
TwoPart<T> two_sum(T a, T b) {
  const T sum = a + b;
  const T b_rounded = sum - a;
  const T a_rounded = sum - b_rounded;
  return {sum, T(a - a_rounded) + T(b - b_rounded)};
}

/// a b = high + low exactly, high = a b rounded.         Source: Ogita, Rump, Oishi 2005, algorithm 3.5.
/// Range: no overflow, and a b = 0 or |a b| >= 2^53 times the smallest normal number (double), where low may underflow.
/// The fused multiply-add is exact by whatever means. Without -mfma it is a call: Horner's rule of degree 20 below then
/// takes 70 ns, by Dekker's splitting of the factors 51 ns, but that overflows from 2^996 on; with -mfma 38 and 63 ns.
template <std::floating_point T>
TwoPart<T> two_product(T a, T b) {
  const T product = a * b;
  return {product, std::fma(a, b, -product)};
}

}  // namespace jetlag
