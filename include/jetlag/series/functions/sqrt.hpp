// SPDX-License-Identifier: MIT
#pragma once
// Square root.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// s = sqrt(f):   s_0 = sqrt(f_0),   s_k = (f_k - sum_{j=1..k-1} s_j s_{k-j}) / (2 s_0).         Source: s^2 = f.
/// Range: f_0 > 0. At f_0 = 0 coefficient 1 is the first that is not finite.
struct Sqrt {
  static constexpr const char* name = "sqrt";
  static constexpr std::array reads{Reads::newest, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& s) {
    using std::sqrt;
    using T = std::decay_t<decltype(s[0] * s[0])>;
    return k == 0 ? T(sqrt(f[0])) : over<T>(f[k] - symmetric_convolution(k, 1, s), s[0] + s[0]);
  }
  static constexpr int two_from = 5;  // from here on both sums have a term
  static auto two_coefficients(int k, const auto& f, const auto& s) {
    using T = std::decay_t<decltype(s[0] * s[0])>;
    const int half = k / 2, last = (k + 1) / 2 - 1;
    const bool even = k % 2 == 0;
    T head(0);
    if (even) head = s[half + 1] * s[half];
    auto [sum, sum_of_next] = two_sums_of_products<T>(  // without the outermost terms s_1 s_{k-1} and s_1 s_k
        last - 1, [&](int i) -> decltype(auto) { return s[k - last + i]; },
        [&](int i) -> decltype(auto) { return s[last - i]; }, even ? &head : nullptr);
    const auto solved = [&](int n, const T& half_of_sum) {
      T all = half_of_sum + half_of_sum;
      if (n % 2 == 0) all = multiply_add<T>(s[n / 2], s[n / 2], all);
      return T((f[n] - all) / (s[0] + s[0]));
    };
    const T newest = solved(k, multiply_add<T>(s[k - 1], s[1], sum));
    return Two<T>{newest, solved(k + 1, multiply_add<T>(newest, s[1], sum_of_next))};
  }
};

}  // namespace jetlag
