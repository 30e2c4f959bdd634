// SPDX-License-Identifier: MIT
#pragma once
// The rules of arithmetic. c is an operand without a series (a constant or a parameter).

#include "jetlag/series/rule.hpp"

namespace jetlag {

/// w = c as a series:   w_0 = c,   w_k = 0.
struct Embed {
  static constexpr const char* name = "embed";
  static constexpr std::array reads{Reads::constant, Reads::nothing};
  static auto coefficient(int k, const auto& c, const auto&) {
    using T = std::decay_t<decltype(c[0])>;
    return k == 0 ? c[0] : T(0);
  }
};

/// w = u + v:   w_k = u_k + v_k.
struct Add {
  static constexpr const char* name = "add";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& v, const auto&) { return u[k] + v[k]; }
};

/// w = u - v:   w_k = u_k - v_k.
struct Subtract {
  static constexpr const char* name = "subtract";
  static constexpr std::array reads{Reads::newest, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& v, const auto&) { return u[k] - v[k]; }
};

/// w = -u:   w_k = -u_k.
struct Negate {
  static constexpr const char* name = "negate";
  static constexpr std::array reads{Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto&) { return -u[k]; }
};

/// w = c + u:   w_0 = c + u_0,   w_k = u_k.
struct Offset {
  static constexpr const char* name = "offset";
  static constexpr std::array reads{Reads::constant, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& c, const auto& u, const auto&) {
    return k == 0 ? c[0] + u[0] : u[k];
  }
};

/// w = c u:   w_k = c u_k.
struct Scale {
  static constexpr const char* name = "scale";
  static constexpr std::array reads{Reads::constant, Reads::newest, Reads::nothing};
  static auto coefficient(int k, const auto& c, const auto& u, const auto&) { return c[0] * u[k]; }
};

/// w = u v (Cauchy):   w_k = sum_{j=0..k} u_j v_{k-j}.
struct Multiply {
  static constexpr const char* name = "multiply";
  static constexpr std::array reads{Reads::history, Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto& v, const auto&) {
    return convolution(k, 0, k, u, v);
  }
  static constexpr int two_from = 0;
  static auto two_coefficients(int k, const auto& u, const auto& v, const auto&) {
    return two_convolutions(k, u, v);
  }
};

/// w = u^2:   w_k = 2 sum_{0<=j<k/2} u_j u_{k-j} + [k even] u_{k/2}^2.
struct Square {
  static constexpr const char* name = "square";
  static constexpr std::array reads{Reads::history, Reads::nothing};
  static auto coefficient(int k, const auto& u, const auto&) { return symmetric_convolution(k, 0, u); }
  static constexpr int two_from = 0;
  static auto two_coefficients(int k, const auto& u, const auto&) { return two_symmetric_convolutions(k, u); }
};

/// q = f / g:   q_k = (f_k - sum_{j=0..k-1} q_j g_{k-j}) / g_0.         Source: f = g q.
/// Range: g_0 != 0. There q_0 is not finite.
struct Divide {
  static constexpr const char* name = "divide";
  static constexpr std::array reads{Reads::newest, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& f, const auto& g, const auto& q) {
    using T = std::decay_t<decltype(f[0] / g[0])>;
    return k == 0 ? T(f[0] / g[0]) : over<T>(f[k] - convolution(k, 0, k - 1, q, g), g[0]);
  }
  static constexpr int two_from = 1;
  static auto two_coefficients(int k, const auto& f, const auto& g, const auto& q) {
    using T = std::decay_t<decltype(f[0] / g[0])>;
    const auto [known_of_next, sum] = two_sums_of_products<T>(
        k, [&](int j) -> decltype(auto) { return g[k + 1 - j]; },
        [&](int j) -> decltype(auto) { return q[j]; });
    const T newest = (f[k] - sum) / g[0];
    return Two<T>{newest, (f[k + 1] - multiply_add<T>(newest, g[1], known_of_next)) / g[0]};
  }
};

/// q = f / c:   q_k = f_k / c.
struct DivideByConstant {
  static constexpr const char* name = "divide by constant";
  static constexpr std::array reads{Reads::newest, Reads::constant, Reads::nothing};
  static auto coefficient(int k, const auto& f, const auto& c, const auto&) {
    return over<std::decay_t<decltype(f[0] / c[0])>>(f[k], c[0]);
  }
};

/// q = c / g:   q_0 = c / g_0,   q_k = -(sum_{j=0..k-1} q_j g_{k-j}) / g_0.         Source: Divide with f = c.
/// Range: g_0 != 0. There q_0 is not finite.
struct Reciprocal {
  static constexpr const char* name = "reciprocal";
  static constexpr std::array reads{Reads::constant, Reads::history, Reads::history};
  static auto coefficient(int k, const auto& c, const auto& g, const auto& q) {
    using T = std::decay_t<decltype(c[0] / g[0])>;
    return k == 0 ? T(c[0] / g[0]) : over<T>(-convolution(k, 0, k - 1, q, g), g[0]);
  }
};

}  // namespace jetlag
