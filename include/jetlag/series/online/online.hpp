// SPDX-License-Identifier: MIT
#pragma once
// A scalar whose operations are the recurrences: one coefficient of all values of a law in straight code.
//
// Called with this scalar once for each order, a law computes that coefficient of every value in it, and keeps it where the next
// orders find it. With the order known to the compiler, and everything inlined, what is left is what a specialist would write:
//
//     double memory[..];
//     Histories histories{memory, 3};
//     const Online x = Online::kept(x_3, histories);      // coefficients 0 .. 2 have been kept in the same way
//     const Online f = 2.0 * sin(x);                      // f.newest() is coefficient 3
//
// The operations of a law come in the same sequence at each order, so that the n-th value finds its history by counting, which
// the compiler does. A value without a series has no history: x + 1.0 does not add at order 3, 2.0 * x is no convolution.
// There are no comparisons: a law that chooses is recorded (tape/recording.hpp).

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "jetlag/series/elementary.hpp"
#include "jetlag/series/online/unrolled.hpp"

namespace jetlag {

/// Coefficients that a history has room for, and histories of an element.
inline constexpr int orders_of_histories = 24;
inline constexpr int most_histories = 128;

/// The histories of the values of one element, one after another; `used` counts those met so far.
struct Histories {
  double* first;
  int order;  // of the coefficients that come now
  int used = 0;
  /// Those beyond the most there may be fall together, and count.
  double* at(int n) const {
    return first + orders_of_histories * (n < most_histories ? n : most_histories - 1);
  }
  double* next() { return at(used++); }
};

class Online {
 public:
  using value_type = Unrolled;

  Online() = default;
  Online(double number) : newest_(number) {}    // implicit: numbers are constants of the law
  Online(Unrolled number) : newest_(number) {}  // NOLINT

  /// A series that is there: its coefficients lie `stride` numbers apart.
  static Online input(const double* first, int stride, Histories& histories) {
    return Online(first[histories.order * stride], first, stride, &histories);
  }
  /// A value with a series, whose next coefficient is kept.
  static Online kept(Unrolled newest, Histories& histories) {
    double* history = histories.next();
    history[histories.order] = newest.value;
    return Online(newest, history, 1, &histories);
  }

  /// The coefficient of this order; of a value without a series the value.
  Unrolled newest() const { return newest_; }
  bool is_number() const { return history_ == nullptr; }
  const double* history() const { return history_; }
  int stride() const { return stride_; }
  Histories* histories() const { return histories_; }

  Online& operator+=(const Online& v);
  Online& operator-=(const Online& v);
  Online& operator*=(const Online& v);
  Online& operator/=(const Online& v);

  /// A value with a series where this one has one.
  Online with(Unrolled newest) const { return is_number() ? Online(newest) : kept(newest, *histories_); }
  /// This series plus a number.
  Online moved_by(Unrolled number) const {
    return kept(histories_->order == 0 ? newest_ + number : newest_, *histories_);
  }

 private:
  Online(Unrolled newest, const double* history, int stride, Histories* histories)
      : newest_(newest), history_(history), stride_(stride), histories_(histories) {
    // What the compiler cannot know otherwise: this is no number.
    if (history == nullptr || histories == nullptr) __builtin_unreachable();
  }

  Unrolled newest_;
  const double* history_ = nullptr;
  int stride_ = 1;
  Histories* histories_ = nullptr;
};

template <>
inline constexpr bool is_series<Online> = true;

namespace detail {

/// An operand as a rule sees it.
struct OnlineSeries {
  Unrolled newest;
  const double* history;  // null: the constant `newest`
  int stride, order;
  Unrolled operator[](int j) const {
    if (history == nullptr) return j == 0 ? newest : Unrolled(0.0);
    return j == order ? newest : Unrolled(history[j * stride]);
  }
};

inline OnlineSeries series_of(const Online& u) {
  return {u.newest(), u.history(), u.stride(), u.is_number() ? 0 : u.histories()->order};
}

/// A result that a rule reads, up to the order before.
struct OlderSeries {
  const double* history;
  Unrolled operator[](int j) const { return history[j]; }
};

template <class... U>
Histories* histories_of(const U&... u) {
  Histories* found = nullptr;
  ((found = u.is_number() ? found : u.histories()), ...);
  return found;
}

template <Rule R, class... U>
Online next_of(const U&... u) {
  Histories* histories = histories_of(u...);
  if (histories == nullptr)
    return Unrolled(
        R::coefficient(0, ConstantSeries<Unrolled>{u.newest()}..., ConstantSeries<Unrolled>{0.0}));
  const OlderSeries result{histories->at(histories->used)};
  return Online::kept(R::coefficient(histories->order, series_of(u)..., result), *histories);
}

template <Rule A, Rule B, class... U>
std::pair<Online, Online> next_of_coupled(const U&... u) {
  Histories* histories = histories_of(u...);
  if (histories == nullptr) {
    const ConstantSeries<Unrolled> none{0.0};
    const ConstantSeries<Unrolled> v{A::coefficient(0, ConstantSeries<Unrolled>{u.newest()}..., none, none)};
    return {v.value, Unrolled(B::coefficient(0, ConstantSeries<Unrolled>{u.newest()}..., v, none))};
  }
  const OlderSeries of_v{histories->at(histories->used)}, of_w{histories->at(histories->used + 1)};
  const int order = histories->order;
  const Online v = Online::kept(A::coefficient(order, series_of(u)..., of_w, of_v), *histories);
  const Online w = Online::kept(B::coefficient(order, series_of(u)..., series_of(v), of_w), *histories);
  return {v, w};
}

}  // namespace detail

/// The next coefficient of v = R(u...).
template <Rule R, std::same_as<Online> S, class... U>
S lift(const U&... u) {
  return detail::next_of<R>(S(u)...);
}

/// The next coefficients of v = A(u..., w), w = B(u..., v).
template <Rule A, Rule B, std::same_as<Online> S, class... U>
std::pair<S, S> lift_coupled(const U&... u) {
  return detail::next_of_coupled<A, B>(S(u)...);
}

inline Online operator+(const Online& u) { return u; }
inline Online operator-(const Online& u) { return u.with(-u.newest()); }
inline Online operator+(const Online& u, const Online& v) {
  if (u.is_number()) return v.is_number() ? Online(u.newest() + v.newest()) : v.moved_by(u.newest());
  return v.is_number() ? u.moved_by(v.newest()) : u.with(u.newest() + v.newest());
}
inline Online operator-(const Online& u, const Online& v) {
  if (u.is_number()) return v.is_number() ? Online(u.newest() - v.newest()) : (-v).moved_by(u.newest());
  return v.is_number() ? u.moved_by(-v.newest()) : u.with(u.newest() - v.newest());
}
inline Online operator*(const Online& u, const Online& v) {
  if (u.is_number() || v.is_number()) return (u.is_number() ? v : u).with(u.newest() * v.newest());
  return u.history() == v.history() ? square(u) : lift<Multiply, Online>(u, v);
}
inline Online operator/(const Online& f, const Online& g) {
  if (!g.is_number()) return f.is_number() ? lift<Reciprocal, Online>(f, g) : lift<Divide, Online>(f, g);
  return f.is_number() ? Online(f.newest() / g.newest()) : lift<DivideByConstant, Online>(f, g);
}
inline Online& Online::operator+=(const Online& v) { return *this = *this + v; }
inline Online& Online::operator-=(const Online& v) { return *this = *this - v; }
inline Online& Online::operator*=(const Online& v) { return *this = *this * v; }
inline Online& Online::operator/=(const Online& v) { return *this = *this / v; }

namespace detail {
/// u^n by repeated squaring. Not inlined: a law with such powers loses the counting of its values, all others a loop at each power.
[[gnu::noinline]] inline Online power_by_squaring(const Online& u, std::uint64_t n) {
  Online product = n % 2 == 0 ? Online(1.0) : u, power = square(u);
  for (std::uint64_t left = n / 2; left > 0; left /= 2) {
    if (left % 2 == 1) product = product * power;
    if (left > 1) power = square(power);
  }
  return product;
}
}  // namespace detail

/// As for jets (series/elementary.hpp). Small powers come without a loop, so that values are counted when compiled.
template <std::integral N>
Online pow(const Online& u, N n) {
  if (n < 0) return pow(Online(1.0) / u, -n);
  if (n == 0) return 1.0;
  if (n == 1) return u;
  if (n == 2) return square(u);
  if (n == 3) return square(u) * u;
  return detail::power_by_squaring(u, static_cast<std::uint64_t>(n));
}
inline Online pow(const Online& u, double a) {
  if (a == std::trunc(a) && std::abs(a) <= 1024) return pow(u, static_cast<int>(a));
  return lift<Power, Online>(a, u);
}
inline Online pow(const Online& u, const Online& v) {
  if (v.is_number()) return pow(u, v.newest().value);
  return lift<PowerOfSeries, Online>(u, v, v * log(u));
}
inline Online pow(double c, const Online& v) {
  return lift<PowerOfSeries, Online>(c, v, v * Online(std::log(c)));
}
inline Online hypot(const Online& x, const Online& y) {
  using S = Online;
  return lift<RootOfScaled, S>(detail::scaled_squares(x, y));
}
inline Online atan2(const Online& y, const Online& x) {
  using S = Online;
  return lift<Atan2, S>(y, x, detail::scaled_squares(x, y));
}

}  // namespace jetlag
