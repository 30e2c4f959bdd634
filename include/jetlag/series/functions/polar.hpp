// SPDX-License-Identifier: MIT
#pragma once
// Polar coordinates: hypot and atan2, and the sum of squares that both are made of.
//
// x_0^2 overflows at 1e154 and vanishes at 1e-162. All squares here are divided by the number h_0 = hypot(x_0, y_0),
// one factor of each product before it is formed: they are of the size of x and y themselves.
// Range: (x_0, y_0) != (0, 0); 1/h_0 and x_j x_{k-j} / h_0 do not overflow.

#include <cmath>

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// l = h_0:   l_0 = hypot(x_0, y_0),   l_k = 0.
struct Length {
  static constexpr const char* name = "length";
  static constexpr std::array reads{Reads::first, Reads::first, Reads::nothing};
  static auto coefficient(int k, const auto& x, const auto& y, const auto&) {
    using std::hypot;
    using T = std::decay_t<decltype(x[0] * y[0])>;
    return k == 0 ? T(hypot(x[0], y[0])) : T(0);
  }
};

/// w = (x^2 + y^2) / h_0:   w_0 = h_0,   w_k = sum_{j=0..k} ((x_j / h_0) x_{k-j} + (y_j / h_0) y_{k-j}).
/// Operands: h_0, x, y.   Range: h_0 != 0. There coefficient 1 is not finite.
struct ScaledSumOfSquares {
  static constexpr const char* name = "scaled sum of squares";
  static constexpr std::array reads{Reads::first, Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& h, const auto& x, const auto& y, const auto&) {
    using T = std::decay_t<decltype(h[0] * x[0])>;
    if (k == 0) return T(h[0]);
    const T r = T(1) / h[0];
    return T(scaled_symmetric_convolution(k, 0, r, x) + scaled_symmetric_convolution(k, 0, r, y));
  }
};

/// w = (x^2 + c) / h_0 with the number c = h_0^2 - x_0^2:   w_0 = h_0,   w_k = sum_{j=0..k} (x_j / h_0) x_{k-j}.
/// Operands: h_0, x.   Range: h_0 != 0. There coefficient 1 is not finite.
struct ScaledSquare {
  static constexpr const char* name = "scaled square";
  static constexpr std::array reads{Reads::first, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& h, const auto& x, const auto&) {
    using T = std::decay_t<decltype(h[0] * x[0])>;
    return k == 0 ? T(h[0]) : scaled_symmetric_convolution(k, 0, T(T(1) / h[0]), x);
  }
};

/// s = sqrt(w_0 w):   s_0 = w_0,   s_k = (w_k - sum_{j=1..k-1} (s_j / s_0) s_{k-j}) / 2.         Source: s^2 / s_0 = w.
/// hypot(x, y) when w is one of the above.   Range: w_0 != 0. There coefficient 1 is not finite.
struct RootOfScaled {
  static constexpr const char* name = "root of scaled";
  static constexpr std::array reads{Reads::newest, Reads::history};
  static auto coefficient(int k, const auto& w, const auto& s) {
    using T = std::decay_t<decltype(s[0] * s[0])>;
    return k == 0 ? T(w[0]) : T((w[k] - scaled_symmetric_convolution(k, 1, T(T(1) / s[0]), s)) / 2);
  }
};

/// a = atan2(y, x), w = (x^2 + y^2) / h_0, r = 1 / h_0:   a_0 = atan2(y_0, x_0), NaN at (0, 0),
/// k w_0 a_k = sum_{k/2<j<=k} (2j - k) (r x_{k-j} y_j - r y_{k-j} x_j) - sum_{j=1..k-1} j a_j w_{k-j}.
/// Source: (x^2 + y^2) a' = x y' - y x'; in the sum of j (x_{k-j} y_j - y_{k-j} x_j) the terms j and k - j are paired.
/// Operands: y, x, w.   Range: (x_0, y_0) != (0, 0). There coefficient 0 is not finite.
struct Atan2 {
  static constexpr const char* name = "atan2";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& y, const auto& x, const auto& w, const auto& a) {
    using std::atan2;
    using T = std::decay_t<decltype(x[0] * a[0])>;
    if (k == 0) return T(atan2(y[0], x[0]) * (w[0] / w[0]));
    const T r = T(1) / w[0];
    T sum = -weighted_convolution(k, 1, k - 1, a, w);
    for (int j = k / 2 + 1; j <= k; ++j) {
      const T weight = (2 * j - k) * r;
      sum = multiply_add<T>(weight * x[k - j], y[j], sum);
      sum = multiply_add<T>(-(weight * y[k - j]), x[j], sum);
    }
    return T(sum / (k * w[0]));
  }
};

/// a = atan2(c, x), w = (x^2 + c^2) / h_0:   w_0 a_k = -(c / h_0) x_k - (1/k) sum_{j=1..k-1} j a_j w_{k-j}.
/// Source: atan2 with y = c.   Operands: c, x, w.   Range: (x_0, c) != (0, 0). There coefficient 0 is not finite.
struct Atan2OfConstant {
  static constexpr const char* name = "atan2 of constant";
  static constexpr std::array reads{Reads::constant, Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& c, const auto& x, const auto& w, const auto& a) {
    using std::atan2;
    using T = std::decay_t<decltype(x[0] * a[0])>;
    if (k == 0) return T(atan2(c[0], x[0]) * (w[0] / w[0]));
    return T(-((c[0] / w[0]) * x[k] + weighted_convolution(k, 1, k - 1, a, w) / k) / w[0]);
  }
};

/// a = atan2(y, c), w = (c^2 + y^2) / h_0:   w_0 a_k = (c / h_0) y_k - (1/k) sum_{j=1..k-1} j a_j w_{k-j}.
/// Source: atan2 with x = c.   Operands: c, y, w.   Range: (c, y_0) != (0, 0). There coefficient 0 is not finite.
struct Atan2OverConstant {
  static constexpr const char* name = "atan2 over constant";
  static constexpr std::array reads{Reads::constant, Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& c, const auto& y, const auto& w, const auto& a) {
    using std::atan2;
    using T = std::decay_t<decltype(y[0] * a[0])>;
    if (k == 0) return T(atan2(y[0], c[0]) * (w[0] / w[0]));
    return T(((c[0] / w[0]) * y[k] - weighted_convolution(k, 1, k - 1, a, w) / k) / w[0]);
  }
};

}  // namespace jetlag
