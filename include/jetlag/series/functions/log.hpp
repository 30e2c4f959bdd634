// SPDX-License-Identifier: MIT
#pragma once
// Logarithms.

#include <cmath>

#include "jetlag/series/constants.hpp"
#include "jetlag/series/rule.hpp"

namespace jetlag {

/// l = log(f):   l_0 = log(f_0),   l_k = (f_k - (1/k) sum_{j=1..k-1} j l_j f_{k-j}) / f_0.         Source: f l' = f'.
/// Range: f_0 > 0. At f_0 = 0 coefficient 0 is not finite.
struct Log {
  static constexpr const char* name = "log";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& l) {
    using std::log;
    if (k == 0) return log(f[0]);
    return (f[k] - weighted_convolution(k, 1, k - 1, l, f) / k) / f[0];
  }
};

/// l = log(1 + f):   l_0 = log1p(f_0),   l_k = (f_k - (1/k) sum_{j=1..k-1} j l_j f_{k-j}) / (1 + f_0).
/// Source: (1 + f) l' = f'.   Range: f_0 > -1. At f_0 = -1 coefficient 0 is not finite.
struct Log1p {
  static constexpr const char* name = "log1p";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& l) {
    using std::log1p;
    using T = std::decay_t<decltype(f[0] * l[0])>;
    if (k == 0) return T(log1p(f[0]));
    return T((f[k] - weighted_convolution(k, 1, k - 1, l, f) / k) / (T(1) + f[0]));
  }
};

/// l = log2(f), c = 1 / log(2):   l_0 = log2(f_0),   l_k = (c f_k - (1/k) sum_{j=1..k-1} j l_j f_{k-j}) / f_0.
/// Source: f l' = c f'.   Range: f_0 > 0. At f_0 = 0 coefficient 0 is not finite.
struct Log2 {
  static constexpr const char* name = "log2";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& l) {
    using std::log2;
    using T = std::decay_t<decltype(f[0] * l[0])>;
    if (k == 0) return T(log2(f[0]));
    return T((Constants<T>::log2_e() * f[k] - weighted_convolution(k, 1, k - 1, l, f) / k) / f[0]);
  }
};

/// l = log10(f), c = 1 / log(10):   l_0 = log10(f_0),   the rest as for log2.
/// Source: f l' = c f'.   Range: f_0 > 0. At f_0 = 0 coefficient 0 is not finite.
struct Log10 {
  static constexpr const char* name = "log10";
  static constexpr std::array reads{Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& l) {
    using std::log10;
    using T = std::decay_t<decltype(f[0] * l[0])>;
    if (k == 0) return T(log10(f[0]));
    return T((Constants<T>::log10_e() * f[k] - weighted_convolution(k, 1, k - 1, l, f) / k) / f[0]);
  }
};

}  // namespace jetlag
