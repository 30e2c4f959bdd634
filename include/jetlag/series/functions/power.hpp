// SPDX-License-Identifier: MIT
#pragma once
// Real powers. Whole exponents are products (see pow in elementary.hpp) and hold at 0 as well.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// p = f^a:   p_0 = f_0^a,   k f_0 p_k = sum_{j=0..k-1} (a (k-j) - j) f_{k-j} p_j.         Source: f p' = a f' p.
/// a: a constant operand.   Range: f_0 > 0. At f_0 = 0 coefficient 1 is not finite.
struct Power {
  static constexpr const char* name = "power";
  static constexpr std::array reads{Reads::constant, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& a, const auto& f, const auto& p) {
    using std::pow;
    using T = std::decay_t<decltype(f[0] * p[0])>;
    if (k == 0) return T(pow(f[0], a[0]));
    return sum_of_products_over<T>(
        k, [&](int j) { return T(weight<T>(k, j, a) * f[k - j]); },
        [&](int j) -> decltype(auto) { return p[j]; }, k, f[0]);
  }
  static constexpr int two_from = 1;
  static auto two_coefficients(int k, const auto& a, const auto& f, const auto& p) {
    using T = std::decay_t<decltype(f[0] * p[0])>;
    T of_next = f[k + 1], sum(0), sum_of_next(0);
    for (int j = 0; j < k; ++j) {
      const T of_this = f[k - j], common = p[j];
      const T here = weight<T>(k, j, a) * of_this, next = weight<T>(k + 1, j, a) * of_next;
      sum = j == 0 ? T(here * common) : multiply_add<T>(here, common, sum);
      sum_of_next = j == 0 ? T(next * common) : multiply_add<T>(next, common, sum_of_next);
      of_next = of_this;
    }
    const T newest = sum / (k * f[0]);
    sum_of_next = multiply_add<T>(T(weight<T>(k + 1, k, a) * f[1]), newest, sum_of_next);
    return Two<T>{newest, sum_of_next / ((k + 1) * f[0])};
  }

 private:
  /// a (k-j) - j
  template <class T>
  static T weight(int k, int j, const auto& a) {
    return multiply_add<T>(T(k - j), T(a[0]), T(-j));
  }
};

/// p = f^g = exp(w), w = g log(f):   p_0 = f_0^g_0,   k p_k = sum_{j=1..k} j w_j p_{k-j}.         Source: p' = w' p.
/// Operands: f, g, w.   Range: f_0 > 0. At f_0 = 0 coefficient 1 is not finite.
struct PowerOfSeries {
  static constexpr const char* name = "power of series";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& g, const auto& w, const auto& p) {
    using std::pow;
    using T = std::decay_t<decltype(w[0] * p[0])>;
    return k == 0 ? T(pow(f[0], g[0])) : T(weighted_convolution(k, 1, k, w, p) / k);
  }
};

}  // namespace jetlag
