// SPDX-License-Identifier: MIT
#pragma once
// Invariants of the right stretch tensor U of a deformation gradient F = R U from those of C = F^T F = U^2 and J = det F:
//
//     a = tr U,   b = (a^2 - tr U^2) / 2:      a^2 = I + 2 b,   b^2 = II + 2 J a,         I = tr C,   II = (I^2 - tr C^2) / 2.
//
// In principal stretches a = s_1 + s_2 + s_3, b = s_1 s_2 + s_2 s_3 + s_3 s_1, J = s_1 s_2 s_3. Where J < 0 the smallest of
// them is the negative one, so that R is a rotation: a is the largest root of ((a^2 - I) / 2)^2 = II + 2 J a. The slope of
// that equation is twice
//
//     q = a b - J = (s_1 + s_2)(s_2 + s_3)(s_3 + s_1) >= 0,
//
// which is zero where two stretches add up to zero: R is not determined there, and jumps where a motion goes through.
// Source: Cayley and Hamilton; A. Hoger, D. Carlson, Determination of the stretch and rotation in the polar decomposition of
// the deformation gradient, Quart. Appl. Math. 42 (1984) 113.

#include <cmath>
#include <limits>
#include <utility>

#include "jetlag/series/coefficients.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

/// a of numbers, by Newton's method from sqrt(3 I) >= a, from above.   Range: I, II, J of a matrix.
template <class T>
[[gnu::always_inline]] inline T first_stretch_invariant(const T& i, const T& ii, const T& j) {
  using std::sqrt;
  if constexpr (is_jet<T>) {
    return stretch_invariants(i, ii, j).first;
  } else {
    T a = sqrt(T(T(3) * i));
    for (;;) {
      const T b = T(a * a - i) / T(2), q = a * b - j;
      const T next = a - T(b * b - ii - T(2) * j * a) / T(q + q);
      if (!(q > T(0)) || !(next < a)) return a;
      a = next;
    }
  }
}

/// b = (a^2 - I) / 2; NaN where rounding does not tell q from zero: errors e < 8 eps (a^2 + I)^2 in the equation move a double
/// root by sqrt(2 e / (3 a^2 - I)), and q by sqrt(e (3 a^2 - I) / 2).   Range: I, J of a matrix, a of them, 1e-50 < a < 1e50.
template <class T>
[[gnu::always_inline]] inline T second_stretch_invariant(const T& i, const T& j, const T& a) {
  if constexpr (is_jet<T>) {
    const auto b = second_stretch_invariant(i[0], j[0], a[0]);
    return b == b ? T(T(a * a - i) / T(2)) : T(b);
  } else {
    const T b = T(a * a - i) / T(2), q = a * b - j, size = a * a + i;
    const T rounding = T(16) * std::numeric_limits<T>::epsilon() * size * size * size;
    return q > T(0) && q * q > rounding ? b : T(std::numeric_limits<double>::quiet_NaN());
  }
}

/// a, b.   Range: I, II, J of a matrix, 1e-50 < a < 1e50. At q = 0 b is NaN.
template <class T>
std::pair<T, T> stretch_invariants(const T& i, const T& ii, const T& j) {
  const T a = first_stretch_invariant(i, ii, j);
  return {a, second_stretch_invariant(i, j, a)};
}

/// a_0 of numbers,   2 q_0 a_k = b_0 (I_k - s_k) + II_k + 2 sum_{j=1..k} J_j a_{k-j} - sum_{j=1..k-1} b_j b_{k-j},
/// s_k = sum_{j=1..k-1} a_j a_{k-j}.         Source: both equations, b_k eliminated.
/// Operands: I, II, J, b.   Range: q_0 > 0. There coefficient 1 is the first that is not finite.
struct FirstStretchInvariant {
  static constexpr const char* name = "first stretch invariant";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::history, Reads::history,
                                    Reads::history};
  static auto coefficient(int k, const auto& i, const auto& ii, const auto& j, const auto& b, const auto& a) {
    using T = std::decay_t<decltype(j[0] * b[0])>;
    if (k == 0) return T(first_stretch_invariant(T(i[0]), T(ii[0]), T(j[0])));
    const T turned = convolution(k, 1, k, j, a), q = a[0] * b[0] - j[0];
    const T known = (ii[k] - symmetric_convolution(k, 1, b)) + (turned + turned);
    return T(multiply_add<T>(b[0], i[k] - symmetric_convolution(k, 1, a), known) / (q + q));
  }
};

/// b_0 of numbers,   b_k = (sum_{j=0..k} a_j a_{k-j} - I_k) / 2.         Source: a^2 = I + 2 b.
/// Operands: I, II, J, a.   Range: q_0 > 0. There coefficient 0 is not finite.
struct SecondStretchInvariant {
  static constexpr const char* name = "second stretch invariant";
  static constexpr std::array reads{Reads::newest, Reads::nothing, Reads::first, Reads::history,
                                    Reads::nothing};
  static auto coefficient(int k, const auto& i, const auto&, const auto& j, const auto& a, const auto&) {
    using T = std::decay_t<decltype(i[0] * a[0])>;
    if (k == 0) return T(second_stretch_invariant(T(i[0]), T(j[0]), T(a[0])));
    return T((symmetric_convolution(k, 0, a) - i[k]) / 2);
  }
};

}  // namespace jetlag
