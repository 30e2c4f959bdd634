// SPDX-License-Identifier: MIT
#pragma once
// Sums, dot products, squared norms and linear combinations as one operation each: what a chain of sums and products
// becomes on a tape (tape/fusion.hpp).

#include <tuple>
#include <utility>

#include "jetlag/series/rule.hpp"

namespace jetlag {

namespace detail {
/// The declaration of a rule that reads n operands alike, and nothing of its own result.
template <int n>
consteval std::array<Reads, n + 1> reads_alike(Reads reads) {
  std::array<Reads, n + 1> all;
  all.fill(reads);
  all[n] = Reads::nothing;
  return all;
}

template <class T>
T plus(const T& a, const T& b) {
  return a + b;
}
template <class T>
Two<T> plus(const Two<T>& a, const Two<T>& b) {
  return {a[0] + b[0], a[1] + b[1]};
}

/// f(0) + f(1) + ... + f(n-1), for numbers or for two orders at once.
template <int n>
auto added(const auto& f) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    auto sum = f(std::integral_constant<std::size_t, 0>{});
    const auto add = [&](const auto& term) { sum = plus(sum, term); };
    (add(f(std::integral_constant<std::size_t, I + 1>{})), ...);
    return sum;
  }(std::make_index_sequence<n - 1>{});
}

/// The declaration of LinearCombination<n>.
template <int n>
consteval std::array<Reads, 2 * n + 2> reads_scaled() {
  std::array<Reads, 2 * n + 2> all;
  all[0] = Reads::newest;
  for (int i = 0; i < n; ++i) all[2 * i + 1] = Reads::constant, all[2 * i + 2] = Reads::newest;
  all[2 * n + 1] = Reads::nothing;
  return all;
}

inline constexpr const char* of_components(const char* const (&names)[3], int n) { return names[n - 2]; }
}  // namespace detail

/// w = u_1 + ... + u_n.
template <int n>
struct Sum {
  static constexpr const char* name = detail::of_components({"sum of 2", "sum of 3", "sum of 4"}, n);
  static constexpr std::array reads = detail::reads_alike<n>(Reads::newest);
  static auto coefficient(int k, const auto&... u) {
    const auto all = std::tie(u...);
    return detail::added<n>([&](auto i) { return std::get<i>(all)[k]; });
  }
};

/// w = u_1^2 + ... + u_n^2, each square as in Square.
template <int n>
struct SquaredNorm {
  static constexpr const char* name =
      detail::of_components({"squared norm of 2", "squared norm of 3", "squared norm of 4"}, n);
  static constexpr std::array reads = detail::reads_alike<n>(Reads::history);
  static auto coefficient(int k, const auto&... u) {
    const auto all = std::tie(u...);
    return detail::added<n>([&](auto i) { return symmetric_convolution(k, 0, std::get<i>(all)); });
  }
  static constexpr int two_from = 0;
  static auto two_coefficients(int k, const auto&... u) {
    const auto all = std::tie(u...);
    return detail::added<n>([&](auto i) { return two_symmetric_convolutions(k, std::get<i>(all)); });
  }
};

/// w = u_1 v_1 + ... + u_n v_n, each product as in Multiply. Operands: u_1, v_1, u_2, v_2, ...
template <int n>
struct Dot {
  static constexpr const char* name = detail::of_components({"dot of 2", "dot of 3", "dot of 4"}, n);
  static constexpr std::array reads = detail::reads_alike<2 * n>(Reads::history);
  static auto coefficient(int k, const auto&... u) {
    const auto all = std::tie(u...);
    return detail::added<n>(
        [&](auto i) { return convolution(k, 0, k, std::get<2 * i>(all), std::get<2 * i + 1>(all)); });
  }
  static constexpr int two_from = 0;
  static auto two_coefficients(int k, const auto&... u) {
    const auto all = std::tie(u...);
    return detail::added<n>(
        [&](auto i) { return two_convolutions(k, std::get<2 * i>(all), std::get<2 * i + 1>(all)); });
  }
};

/// w = u_1 v_1 - u_2 v_2, each product as in Multiply: a component of a cross product, a determinant.
struct DifferenceOfProducts {
  static constexpr const char* name = "difference of products";
  static constexpr std::array reads = detail::reads_alike<4>(Reads::history);
  static auto coefficient(int k, const auto& u1, const auto& v1, const auto& u2, const auto& v2,
                          const auto&) {
    return convolution(k, 0, k, u1, v1) - convolution(k, 0, k, u2, v2);
  }
  static constexpr int two_from = 0;
  static auto two_coefficients(int k, const auto& u1, const auto& v1, const auto& u2, const auto& v2,
                               const auto&) {
    auto first = two_convolutions(k, u1, v1);
    const auto second = two_convolutions(k, u2, v2);
    for (int i = 0; i < 2; ++i) first[i] = first[i] - second[i];
    return first;
  }
};

/// w = v + c_1 u_1 + ... + c_n u_n with numbers c:   w_k = v_k + c_1 u_{1,k} + ...   Operands: v, c_1, u_1, c_2, u_2, ...
/// Products are rounded before they are added: what is added and taken away is gone, on every machine.
template <int n>
struct LinearCombination {
  static constexpr std::array<const char*, 5> names{"linear combination of 1", "linear combination of 2",
                                                    "linear combination of 3", "linear combination of 4",
                                                    "linear combination of 5"};
  static constexpr const char* name = names[n - 1];
  static constexpr std::array reads = detail::reads_scaled<n>();
  static auto coefficient(int k, const auto& v, const auto&... scaled) {
    using T = std::decay_t<decltype(v[k] + v[k])>;
    const auto all = std::tie(scaled...);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      T sum = v[k];
      ((sum = sum + T(std::get<2 * I>(all)[0] * std::get<2 * I + 1>(all)[k])), ...);
      return sum;
    }(std::make_index_sequence<n>{});
  }
};

}  // namespace jetlag
