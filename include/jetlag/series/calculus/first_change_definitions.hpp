// SPDX-License-Identifier: MIT
#pragma once
// The definitions of first_change.hpp, which includes them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "jetlag/series/calculus/first_change.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "jetlag/series/calculus/roots.hpp"

namespace jetlag {

namespace detail {

template <class T>
int sign_as_number(const T& x) {
  return (x > T(0)) - (x < T(0));
}

/// The first s in (low, high] with c(s) on the other side than `side` by more than 4 (N+1) eps sum_k |c_k| s^k, to the last
/// bits; nothing if none is met. It is sought at distances from `low` that double, from `least` on.
template <class T>
std::optional<T> clearly_beyond(std::span<const T> c, int side, const T& low, const T& high, const T& least) {
  const T eps = std::numeric_limits<T>::epsilon();
  const auto beyond = [&](const T& s) {
    using std::abs;
    T value(0), size(0);
    for (std::size_t k = c.size(); k-- > 0;) {
      value = value * s + c[k];
      size = size * s + abs(c[k]);
    }
    return T(-side) * value > T(4.0 * static_cast<double>(c.size())) * eps * size;
  };
  T before = low, after = high;
  for (T width = least; low + width < high; width = width + width) {
    after = low + width;
    if (beyond(after)) break;
    before = after;
    after = high;
  }
  if (!beyond(after)) return std::nullopt;
  while (after - before > T(2) * eps * after) {
    const T middle = before + (after - before) / T(2);
    if (!(before < middle && middle < after)) break;
    (beyond(middle) ? after : before) = middle;
  }
  return after;
}

}  // namespace detail

template <class T>
T reach_of_condition(std::span<const T> c, T h) {
  using std::abs, std::isfinite;
  const int n = static_cast<int>(c.size()) - 1;
  const double left_out =
      std::max(static_cast<double>(std::numeric_limits<T>::epsilon()), std::exp(-2.0 * (n - 1)));
  const int last_terms = n == 2 ? 1 : 2;  // a term of order 1 is no sign of a series that has not ended
  if (n < 2 || !isfinite(c[0]) || (c[0] == T(0) && !isfinite(c[1]))) return h;
  for (int attempt = 0; attempt < 60; ++attempt) {
    T power(1), sum(0), last(0);
    for (int k = 0; k <= n; ++k) {
      const T term = abs(c[k]) * power;
      if (!isfinite(term)) {
        last = sum = term;
        break;
      }
      sum += term;
      if (k > n - last_terms) last += term;
      power *= h;
    }
    if (!isfinite(sum)) {
      h = h / T(16);
      continue;
    }
    const double ratio = static_cast<double>(T(last / sum)) / left_out;
    if (!(ratio > 1)) return h;
    h = h * T(std::max(0.0625, 0.95 * std::pow(ratio, -1.0 / (n - 1))));
  }
  return h;
}

template <class T>
std::optional<T> first_change(std::span<const T> c, int at_zero, const T& h) {
  using std::abs, std::isfinite;
  T power(1);
  std::size_t known = 0;  // with terms that neither overflow nor make sums overflow
  while (known < c.size() && isfinite(c[known]) && T(abs(c[known]) * power) < T(1e250)) {
    ++known;
    power *= h;
  }
  c = c.first(known);
  while (!c.empty() && c.back() == T(0)) c = c.first(c.size() - 1);
  if (c.empty()) return std::nullopt;

  const T least = h * T(0x1p-200);
  int side = detail::sign_as_number(c[0]);
  if (side == 0) {
    const int goes = detail::sign_as_number(
        *std::ranges::find_if_not(c, [](const T& x) { return x == T(0); }));  // there is one
    side = at_zero != 0 ? at_zero : goes;
    if (goes != side) return least;
  }
  T rest(0);
  for (std::size_t k = c.size() - 1; k > 0; --k) rest = (rest + abs(c[k])) * h;
  if (rest < abs(c[0])) return std::nullopt;

  std::vector<double> rounded(c.size());
  std::ranges::transform(c, rounded.begin(), [](const T& x) { return static_cast<double>(x); });
  const std::vector<SignChange> changes = sign_changes(rounded, static_cast<double>(h));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i].rising != (side < 0)) continue;
    const T root = T(changes[i].s * (1 - 0x1p-50)), end = i + 1 < changes.size() ? T(changes[i + 1].s) : h;
    if (const auto s = detail::clearly_beyond(c, side, root, end, T(root * T(0x1p-53)))) return s;
  }
  return std::nullopt;
}

template <class T>
void find_first_change(std::span<const T> c, int at_zero, T& most, std::optional<T>& first) {
  if (const T reach = reach_of_condition<T>(c, most); reach < most) {
    most = reach;
    first.reset();
  }
  if (const auto s = first_change<T>(c, at_zero, most)) {
    most = *s;
    first = s;
  }
}

template <class T>
void find_first_change_of_root(std::span<const T> f, std::span<const T> c, int at_zero, T& most,
                               std::optional<T>& first) {
  T reach = most;
  std::optional<T> crossing;
  find_first_change<T>(f, 0, reach, crossing);
  if (!crossing) return find_first_change<T>(c, at_zero, most, first);
  most = reach;
  first = crossing;
}

}  // namespace jetlag
