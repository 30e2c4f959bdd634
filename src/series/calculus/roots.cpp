// SPDX-License-Identifier: MIT
#include "jetlag/series/calculus/roots.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/bernstein.hpp"
#include "jetlag/series/calculus/polynomial.hpp"

/// With the instruction for it where there is one: otherwise std::fma is a call. The same bits from both.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define JETLAG_FUSED [[gnu::target_clones("fma", "default")]]
#else
#define JETLAG_FUSED
#endif

namespace jetlag {

JETLAG_FUSED double accurate_value(std::span<const double> c, double s) {
  if (c.empty()) return 0;
  double value = c.back(), error = 0;
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    const double product = value * s, sum = product + c[k], part = sum - product;
    error = error * s + (std::fma(value, s, -product) + ((product - (sum - part)) + (c[k] - part)));
    value = sum;
  }
  return std::isfinite(error) ? value + error : value;
}

namespace {

using Coefficients = std::vector<double>;

/// An interval, and the polynomial on it in the Bernstein basis.
struct Span {
  double low, high;
  Coefficients b;
};

Coefficients to_bernstein(std::span<const double> c, double h) {
  Coefficients b(c.size());
  double power = 1;
  for (std::size_t k = 0; k < c.size(); ++k) {
    b[k] = c[k] * power;
    power *= h;
  }
  detail::to_bernstein<1>(b.data(), c.size() - 1);
  return b;
}

int sign(double x) { return (x > 0) - (x < 0); }

int sign_variations(const Coefficients& b) {
  int count = 0, last = 0;
  for (const double x : b) {
    if (last * sign(x) < 0) ++count;
    if (x != 0) last = sign(x);
  }
  return count;
}

double largest(const Coefficients& b) {
  double most = 0;
  for (const double x : b) most = std::max(most, std::abs(x));
  return most;
}

/// The part of a span before u and the part after it.
std::pair<Span, Span> split(const Span& span, double u) {
  const std::size_t n = span.b.size() - 1;
  const double middle = span.low + u * (span.high - span.low);
  Span before{span.low, middle, Coefficients(n + 1)}, after{middle, span.high, span.b};
  detail::split_bernstein<1>(after.b.data(), before.b.data(), n, u);
  return {std::move(before), std::move(after)};
}

/// A split at a place where the sign of the polynomial is certain, or as certain as possible.
std::pair<Span, Span> split_beside_roots(const Span& span, std::span<const double> c) {
  std::pair<Span, Span> best;
  double most = -1;
  for (const double u : {0.5, 0.4375, 0.5625, 0.375, 0.625}) {
    auto parts = split(span, u);
    const double value = std::abs(parts.second.b.front());
    const bool certain = value > rounding_of(c, parts.second.low);
    if (certain || value > most) {
      most = value;
      best = std::move(parts);
    }
    if (certain) break;
  }
  return best;
}

/// Places that leave at most one change of sign between neighbours; the last is the end of the span.
void separate(const Span& span, std::span<const double> c, std::vector<double>& places) {
  const bool can_be_split = span.low + 0.375 * (span.high - span.low) > span.low &&
                            span.low + 0.625 * (span.high - span.low) < span.high;
  if (!can_be_split || sign_variations(span.b) <= 1 || largest(span.b) <= rounding_of(c, span.high)) {
    places.push_back(span.high);
    return;
  }
  const auto [before, after] = split_beside_roots(span, c);
  separate(before, c, places);
  separate(after, c, places);
}

struct Magnitudes {
  std::span<const double> c;
  std::size_t size() const { return c.size(); }
  double operator[](std::size_t k) const { return std::abs(c[k]); }
};

/// The sign of c(s) in real arithmetic. Where the digits of accurate_value do not tell, Horner's rule goes on in sums of
/// doubles that do not overlap, without a rounding: N (N+1) products at most.
/// Source: Shewchuk, Discrete Comput. Geom. 18 (1997) 305: scale-expansion, grow-expansion.   Range: no underflow.
int exact_sign(std::span<const double> c, double s) {
  const double value = accurate_value(c, s);
  const double n = static_cast<double>(c.size()) * std::numeric_limits<double>::epsilon();
  if (!(std::abs(value) <= 2 * n * n * evaluate(Magnitudes{c}, s))) return sign(value);
  std::vector<double> sum, next;  // components of rising size, none of them 0
  const auto put = [&next](double x) {
    if (x != 0) next.push_back(x);
  };
  for (std::size_t k = c.size(); k-- > 0;) {
    double carry = 0;
    for (const double x : sum) {  // sum * s
      const auto product = two_product(x, s);
      const auto low = two_sum(carry, product.low);
      const auto high = two_sum(product.high, low.high);
      put(low.low), put(high.low);
      carry = high.high;
    }
    put(carry);
    std::swap(sum, next), next.clear();
    carry = c[k];
    for (const double x : sum) {  // sum + c_k
      const auto both = two_sum(carry, x);
      put(both.low);
      carry = both.high;
    }
    put(carry);
    std::swap(sum, next), next.clear();
  }
  return sum.empty() ? 0 : sign(sum.back());
}

/// Whether c(s) goes one way from 0 to h: |c_1| > sum_{k>1} k |c_k| h^(k-1), by more than rounding.
bool is_monotone(std::span<const double> c, double h) {
  double others = 0;
  for (std::size_t k = c.size(); k-- > 2;) others = (others + static_cast<double>(k) * std::abs(c[k])) * h;
  return std::abs(c[1]) > 1.001 * others;
}

/// Where c changes sign between low, where it has the sign `side`, and high, where it has the other: by Newton's method, from the
/// secant on; where that leads out of what is left of the interval, by halving. Near the place, if it is a simple root to a
/// few roundings.
double approximate_root(std::span<const double> c, int side, double low, double high) {
  constexpr int most = 12;
  const double first = accurate_value(c, low), last = accurate_value(c, high);
  double s = low + (high - low) * (first / (first - last));
  for (int i = 0; i < most; ++i) {
    if (!(low < s && s < high)) s = low + 0.5 * (high - low);
    double value = c.back(), slope = 0;
    for (std::size_t k = c.size() - 1; k-- > 0;) {
      slope = slope * s + value;
      value = value * s + c[k];
    }
    (sign(value) == side ? low : high) = s;
    const double next = s - value / slope;
    if (std::abs(next - s) <= 0x1p-24 * s) {
      const double nearest = next - accurate_value(c, next) / slope;
      return low <= nearest && nearest <= high ? nearest : s;
    }
    s = next;
  }
  return s;
}

/// The first double in (low, high] at which c no longer has the sign `side`; low >= 0 has it, high has the other.
/// Doubles >= 0 are ordered as their bits are. From where the root is nearly the steps grow until it is passed, then halvings
/// of the bits find it: two signs where it is known to the last bit, some 85 at most.
double first_beyond(std::span<const double> c, int side, double low, double high) {
  auto has = std::bit_cast<std::uint64_t>(low), has_not = std::bit_cast<std::uint64_t>(high);
  const auto look = [&](std::uint64_t bits) {
    const bool same = exact_sign(c, std::bit_cast<double>(bits)) == side;
    (same ? has : has_not) = bits;
    return same;
  };
  const double near = approximate_root(c, side, low, high);
  if (low < near && near < high) {
    const bool is_before = look(std::bit_cast<std::uint64_t>(near));
    for (std::uint64_t step = 1; step < has_not - has; step *= 8)
      if (look(is_before ? has + step : has_not - step) != is_before) break;
  }
  while (has_not - has > 1) look(has + (has_not - has) / 2);
  return std::bit_cast<double>(has_not);
}

}  // namespace

double rounding_of(std::span<const double> c, double s) {
  return 4 * static_cast<double>(c.size()) * std::numeric_limits<double>::epsilon() *
         evaluate(Magnitudes{c}, std::abs(s));
}

std::vector<SignChange> sign_changes(std::span<const double> c, double h) {
  if (!(h > 0) || !std::isfinite(h))
    throw std::invalid_argument("sign_changes: h must be > 0 and finite, got " + shown(h));
  for (std::size_t k = 0; k < c.size(); ++k)
    if (!std::isfinite(c[k]))
      throw std::invalid_argument("sign_changes: coefficient " + std::to_string(k) + " is not finite");
  while (!c.empty() && c.back() == 0) c = c.first(c.size() - 1);
  while (!c.empty() && c.front() == 0) c = c.last(c.size() - 1);  // c / s has the same signs
  if (c.size() < 2) return {};

  // A little further than h, so that the polynomial itself says whether a root at h crosses or touches.
  const double end = h * (1 + 0x1p-16);
  const double sum = evaluate(Magnitudes{c}, end);
  if (!std::isfinite(sum))
    throw std::invalid_argument("sign_changes: the polynomial overflows at h = " + shown(h));
  if (sum < 1.5 * std::abs(c[0])) return {};  // c_0 outweighs the rest

  std::vector<double> places;
  if (is_monotone(c, end))
    places.push_back(end);
  else
    separate({0, end, to_bernstein(c, end)}, c, places);

  std::vector<SignChange> found;
  int side = sign(c[0]);
  double low = 0;
  for (const double place : places) {
    const double value = accurate_value(c, place);
    if (place != end && std::abs(value) <= rounding_of(c, place)) continue;
    if (exact_sign(c, place) == -side) {
      const double s = first_beyond(c, side, low, place);
      if (s <= h) found.push_back({s, side < 0});
      side = -side;
    }
    low = place;
  }
  return found;
}

}  // namespace jetlag
