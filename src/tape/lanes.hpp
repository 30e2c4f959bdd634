// SPDX-License-Identifier: MIT
#pragma once
// Lanes of doubles for the instruction set this file is compiled for, and the table of kernels on them.
//
// Included once by each of kernels_sse2.cpp, kernels_avx2.cpp, kernels_avx512.cpp, which define
// JETLAG_INSTRUCTION_SET_NAME and are compiled with that set's flags. Everything here lies in a namespace of
// that name, so that no function compiled for one instruction set can be linked in place of another's.

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jetlag/series/function_names.hpp"
#include "jetlag/tape/kernels.hpp"

namespace jetlag::JETLAG_INSTRUCTION_SET_NAME {

#if defined(__AVX512F__)
using Register = __m512d;
inline Register broadcast(double x) { return _mm512_set1_pd(x); }
inline Register load(const double* from) { return _mm512_load_pd(from); }
inline void store(double* to, Register x) { _mm512_store_pd(to, x); }
inline Register fused(Register a, Register b, Register c) { return _mm512_fmadd_pd(a, b, c); }
inline Register root(Register x) { return _mm512_sqrt_pd(x); }
#elif defined(__AVX2__) && defined(__FMA__)
using Register = __m256d;
inline Register broadcast(double x) { return _mm256_set1_pd(x); }
inline Register load(const double* from) { return _mm256_load_pd(from); }
inline void store(double* to, Register x) { _mm256_store_pd(to, x); }
inline Register fused(Register a, Register b, Register c) { return _mm256_fmadd_pd(a, b, c); }
inline Register root(Register x) { return _mm256_sqrt_pd(x); }
#else
using Register = __m128d;
inline Register broadcast(double x) { return _mm_set1_pd(x); }
inline Register load(const double* from) { return _mm_load_pd(from); }
inline void store(double* to, Register x) { _mm_store_pd(to, x); }
inline Register fused(Register a, Register b, Register c) { return a * b + c; }  // no FMA: rounded twice
inline Register root(Register x) { return _mm_sqrt_pd(x); }
#endif

inline constexpr int register_width = sizeof(Register) / sizeof(double);

#if defined(__FMA__)
inline constexpr bool has_fused_products = true;
#else
inline constexpr bool has_fused_products = false;
#endif

#if defined(__AVX2__)
/// Four rows of four become four columns.
inline void transpose(__m256d (&r)[4]) {
  const __m256d low01 = _mm256_unpacklo_pd(r[0], r[1]), high01 = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d low23 = _mm256_unpacklo_pd(r[2], r[3]), high23 = _mm256_unpackhi_pd(r[2], r[3]);
  r[0] = _mm256_permute2f128_pd(low01, low23, 0x20);
  r[1] = _mm256_permute2f128_pd(high01, high23, 0x20);
  r[2] = _mm256_permute2f128_pd(low01, low23, 0x31);
  r[3] = _mm256_permute2f128_pd(high01, high23, 0x31);
}

inline void gather_rows_of_three(int lanes, const double* from, const int* plus, const int* minus,
                                 double* const* to) {
  for (int lane = 0; lane < lanes; lane += 4) {
    __m256d r[4];
    for (int i = 0; i < 4; ++i) r[i] = _mm256_load_pd(from + plus[lane + i]);
    if (minus)
      for (int i = 0; i < 4; ++i) r[i] -= _mm256_load_pd(from + minus[lane + i]);
    transpose(r);
    for (int c = 0; c < 3; ++c) _mm256_store_pd(to[c] + lane, r[c]);
  }
}

inline void scatter_rows_of_three(int active, const double* const* f, const int* plus, const int* minus,
                                  double* into) {
  for (int lane = 0; lane < active; lane += 4) {
    __m256d r[4];
    for (int c = 0; c < 3; ++c) r[c] = _mm256_load_pd(f[c] + lane);
    r[3] = _mm256_setzero_pd();
    transpose(r);
    for (int i = 0; i < 4 && lane + i < active; ++i) {
      double* row = into + plus[lane + i];
      _mm256_store_pd(row, _mm256_load_pd(row) + r[i]);
      if (!minus) continue;
      row = into + minus[lane + i];
      _mm256_store_pd(row, _mm256_load_pd(row) - r[i]);
    }
  }
}
#endif

/// Component c of a register's worth of rows, assembled in the register: what goes through memory number by number is
/// not yet there when it is loaded as a whole.
template <std::size_t... lane>
inline Register column(const double* from, const int* row, int c, std::index_sequence<lane...>) {
  return Register{from[row[lane] + c]...};
}

/// Rows of one or two coordinates.
template <int D>
inline void gather_short_rows(int lanes, const double* from, const int* plus, const int* minus,
                              double* const* to) {
  constexpr auto all = std::make_index_sequence<register_width>();
  for (int lane = 0; lane < lanes; lane += register_width)
    for (int c = 0; c < D; ++c) {
      Register x = column(from, plus + lane, c, all);
      if (minus) x -= column(from, minus + lane, c, all);
      store(to[c] + lane, x);
    }
}

/// n registers of doubles with the arithmetic of one number.
template <int n>
struct Lanes {
  static constexpr int registers = n;
  static constexpr int width = register_width * n;
  static constexpr bool fuses = has_fused_products;
  Register r[n];

  Lanes() = default;
  explicit Lanes(double x) {
    for (auto& v : r) v = broadcast(x);
  }
  static Lanes load(const double* from) {
    Lanes x;
    for (int i = 0; i < n; ++i) x.r[i] = JETLAG_INSTRUCTION_SET_NAME::load(from + i * register_width);
    return x;
  }
  static void store(double* to, const Lanes& x) {
    for (int i = 0; i < n; ++i) JETLAG_INSTRUCTION_SET_NAME::store(to + i * register_width, x.r[i]);
  }
  template <int D>
  static void gather_short_rows(int lanes, const double* from, const int* plus, const int* minus,
                                double* const* to) {
    JETLAG_INSTRUCTION_SET_NAME::gather_short_rows<D>(lanes, from, plus, minus, to);
  }
#if defined(__AVX2__)
  static void gather_rows_of_three(int lanes, const double* from, const int* plus, const int* minus,
                                   double* const* to) {
    JETLAG_INSTRUCTION_SET_NAME::gather_rows_of_three(lanes, from, plus, minus, to);
  }
  static void scatter_rows_of_three(int active, const double* const* f, const int* plus, const int* minus,
                                    double* into) {
    JETLAG_INSTRUCTION_SET_NAME::scatter_rows_of_three(active, f, plus, minus, into);
  }
#endif
};

template <int n, class F>
inline Lanes<n> each_register(F f) {
  Lanes<n> out;
  for (int i = 0; i < n; ++i) out.r[i] = f(i);
  return out;
}

template <int n>
inline Lanes<n> operator+(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] + b.r[i]; });
}
template <int n>
inline Lanes<n> operator-(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] - b.r[i]; });
}
template <int n>
inline Lanes<n> operator-(const Lanes<n>& a) {
  return each_register<n>([&](int i) { return -a.r[i]; });
}
template <int n>
inline Lanes<n> operator*(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] * b.r[i]; });
}
template <int n>
inline Lanes<n> operator/(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] / b.r[i]; });
}
template <int n>
inline Lanes<n> operator*(double x, const Lanes<n>& a) {
  return Lanes<n>(x) * a;
}
template <int n>
inline Lanes<n> operator-(const Lanes<n>& a, double x) {
  return a - Lanes<n>(x);
}
template <int n>
inline Lanes<n> operator/(const Lanes<n>& a, double x) {
  return a / Lanes<n>(x);
}
template <int n>
inline Lanes<n> sqrt(const Lanes<n>& a) {
  return each_register<n>([&](int i) { return root(a.r[i]); });
}

/// One number, compiled for this instruction set: for scenes with a single element.
struct One {
  static constexpr int width = 1;
  static constexpr bool fuses = has_fused_products;
  double x;

  One() = default;
  explicit One(double value) : x(value) {}
  static One load(const double* from) { return One(*from); }
  static void store(double* to, const One& value) { *to = value.x; }
};
inline One operator+(One a, One b) { return One(a.x + b.x); }
inline One operator-(One a, One b) { return One(a.x - b.x); }
inline One operator-(One a) { return One(-a.x); }
inline One operator*(One a, One b) { return One(a.x * b.x); }
inline One operator/(One a, One b) { return One(a.x / b.x); }
inline One operator*(double x, One a) { return One(x * a.x); }
inline One operator-(One a, double x) { return One(a.x - x); }
inline One operator/(One a, double x) { return One(a.x / x); }
inline One sqrt(One a) { return One(::sqrt(a.x)); }

/// f lane by lane, for the functions that the instruction set lacks; they are needed at order 0 only.
template <int n>
[[gnu::noinline]] Lanes<n> each_lane(const Lanes<n>& a, double (*f)(double)) {
  alignas(64) double x[Lanes<n>::width];
  Lanes<n>::store(x, a);
  for (double& v : x) v = f(v);
  return Lanes<n>::load(x);
}
template <int n>
[[gnu::noinline]] Lanes<n> each_lane(const Lanes<n>& a, const Lanes<n>& b, double (*f)(double, double)) {
  alignas(64) double x[Lanes<n>::width], y[Lanes<n>::width];
  Lanes<n>::store(x, a);
  Lanes<n>::store(y, b);
  for (int i = 0; i < Lanes<n>::width; ++i) x[i] = f(x[i], y[i]);
  return Lanes<n>::load(x);
}
template <int n>
[[gnu::noinline]] Lanes<n> each_lane(const Lanes<n>& a, const Lanes<n>& b, const Lanes<n>& c,
                                     double (*f)(double, double, double)) {
  alignas(64) double x[Lanes<n>::width], y[Lanes<n>::width], z[Lanes<n>::width];
  Lanes<n>::store(x, a);
  Lanes<n>::store(y, b);
  Lanes<n>::store(z, c);
  for (int i = 0; i < Lanes<n>::width; ++i) x[i] = f(x[i], y[i], z[i]);
  return Lanes<n>::load(x);
}
inline One each_lane(One a, double (*f)(double)) { return One(f(a.x)); }
inline One each_lane(One a, One b, double (*f)(double, double)) { return One(f(a.x, b.x)); }
inline One each_lane(One a, One b, One c, double (*f)(double, double, double)) {
  return One(f(a.x, b.x, c.x));
}

template <class L>
concept AnyLane = requires(const L& a, double (*f)(double)) { each_lane(a, f); };
#define JETLAG_LANE_BY_LANE(f) \
  template <AnyLane L>         \
  inline L f(const L& a) {     \
    return each_lane(a, ::f);  \
  }
JETLAG_FUNCTIONS_OF_ONE(JETLAG_LANE_BY_LANE)
#undef JETLAG_LANE_BY_LANE
template <AnyLane L>
inline L exp_of_minus_square(const L& a) {
  return each_lane(a, [](double x) { return jetlag::exp_of_minus_square(x); });
}
template <AnyLane L>
inline L first_stretch_invariant(const L& i, const L& ii, const L& j) {
  return each_lane(i, ii, j,
                   [](double x, double y, double z) { return jetlag::first_stretch_invariant(x, y, z); });
}
template <AnyLane L>
inline L second_stretch_invariant(const L& i, const L& j, const L& a) {
  return each_lane(i, j, a,
                   [](double x, double y, double z) { return jetlag::second_stretch_invariant(x, y, z); });
}
#define JETLAG_LANE_BY_LANE(f)         \
  template <AnyLane L>                 \
  inline L f(const L& a, const L& b) { \
    return each_lane(a, b, ::f);       \
  }
JETLAG_LANE_BY_LANE(pow)
JETLAG_LANE_BY_LANE(hypot)
JETLAG_LANE_BY_LANE(atan2)
#undef JETLAG_LANE_BY_LANE

// Choices (series/conditions.hpp, series/functions/sign.hpp): each lane by its own number.
template <int n>
inline Lanes<n> less(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] < b.r[i] ? broadcast(1) : broadcast(0); });
}
template <int n>
inline Lanes<n> less_or_equal(const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return a.r[i] <= b.r[i] ? broadcast(1) : broadcast(0); });
}
template <int n>
inline Lanes<n> where(const Lanes<n>& c, const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) { return c.r[i] == broadcast(0) ? b.r[i] : a.r[i]; });
}
template <int n>
inline Lanes<n> sign_of(
    const Lanes<n>& x) {  // NaN, which is neither above nor below nor at 0, stays what it is
  return each_register<n>([&](int i) {
    const Register zero = broadcast(0), not_above = x.r[i] < zero ? broadcast(-1) : x.r[i];
    return x.r[i] > zero ? broadcast(1) : not_above + zero;
  });
}
template <int n>
inline Lanes<n> by_sign(const Lanes<n>& s, const Lanes<n>& a, const Lanes<n>& b) {
  return each_register<n>([&](int i) {
    const Register not_above = s.r[i] <= broadcast(0) ? a.r[i] : s.r[i];
    return s.r[i] > broadcast(0) ? b.r[i] : not_above;
  });
}

inline One less(One a, One b) { return One(a.x < b.x ? 1 : 0); }
inline One less_or_equal(One a, One b) { return One(a.x <= b.x ? 1 : 0); }
inline One where(One c, One a, One b) { return c.x == 0 ? b : a; }
inline One sign_of(One x) { return x.x > 0 ? One(1) : x.x < 0 ? One(-1) : One(x.x + 0.0); }
inline One by_sign(One s, One a, One b) { return s.x > 0 ? b : s.x <= 0 ? a : s; }

extern const KernelTable<double> of_one, of_4, of_8, of_16, table;

}  // namespace jetlag::JETLAG_INSTRUCTION_SET_NAME

namespace jetlag {
/// a b + c in one rounding where the instruction set has it. The latency of a fused multiply-add is hidden by others in flight, up
/// to eight of them: those of several registers and of two orders at once. With so wide registers that a narrow block fills one
/// or two it spreads its sums over partial ones besides; four numbers a register gained 12 % without (three bodies, six).
#define JETLAG_MULTIPLY_ADD(n)                                                                        \
  template <>                                                                                         \
  inline JETLAG_INSTRUCTION_SET_NAME::Lanes<n> multiply_add(                                          \
      const JETLAG_INSTRUCTION_SET_NAME::Lanes<n>& a, const JETLAG_INSTRUCTION_SET_NAME::Lanes<n>& b, \
      const JETLAG_INSTRUCTION_SET_NAME::Lanes<n>& c) {                                               \
    using namespace JETLAG_INSTRUCTION_SET_NAME;                                                      \
    return each_register<n>([&](int i) { return fused(a.r[i], b.r[i], c.r[i]); });                    \
  }
JETLAG_MULTIPLY_ADD(1)
JETLAG_MULTIPLY_ADD(2)
JETLAG_MULTIPLY_ADD(4)
#undef JETLAG_MULTIPLY_ADD
template <>
inline JETLAG_INSTRUCTION_SET_NAME::One multiply_add(const JETLAG_INSTRUCTION_SET_NAME::One& a,
                                                     const JETLAG_INSTRUCTION_SET_NAME::One& b,
                                                     const JETLAG_INSTRUCTION_SET_NAME::One& c) {
#if defined(__FMA__)
  return JETLAG_INSTRUCTION_SET_NAME::One(__builtin_fma(a.x, b.x, c.x));
#else
  return JETLAG_INSTRUCTION_SET_NAME::One(a.x * b.x + c.x);
#endif
}
#if defined(__AVX512F__)
template <>
inline constexpr int partial_sums<JETLAG_INSTRUCTION_SET_NAME::Lanes<1>> = 2;
template <>
inline constexpr int partial_sums<JETLAG_INSTRUCTION_SET_NAME::Lanes<2>> = 2;
#endif
template <>
inline constexpr int partial_sums<JETLAG_INSTRUCTION_SET_NAME::One> = 4;

template <JETLAG_INSTRUCTION_SET_NAME::AnyLane L>
struct Constants<L> {
  static L log2_e() { return L(std::numbers::log2e); }
  static L log10_e() { return L(std::numbers::log10e); }
  static L two_over_sqrt_pi() { return L(2 * std::numbers::inv_sqrtpi); }
};
}  // namespace jetlag

namespace jetlag::JETLAG_INSTRUCTION_SET_NAME {
#define JETLAG_STRING_(x) #x
#define JETLAG_STRING(x) JETLAG_STRING_(x)
#define JETLAG_NAME JETLAG_STRING(JETLAG_INSTRUCTION_SET_NAME)
constinit const KernelTable<double> of_one = detail::make_kernels<One, double, 1>(JETLAG_NAME, Rules{});
/// As many registers as a block fills, up to four.
template <int lanes>
using LanesOf = Lanes<std::min(4, lanes / register_width)>;

#if !defined(__AVX512F__)
constinit const KernelTable<double> of_4 =
    detail::make_kernels<LanesOf<4>, double, 4>(JETLAG_NAME, Rules{}, &of_one);
constexpr const KernelTable<double>* narrower_than_8 = &of_4;
#else
constexpr const KernelTable<double>* narrower_than_8 = &of_one;
#endif
constinit const KernelTable<double> of_8 =
    detail::make_kernels<LanesOf<8>, double, 8>(JETLAG_NAME, Rules{}, narrower_than_8);
constinit const KernelTable<double> of_16 =
    detail::make_kernels<LanesOf<16>, double, 16>(JETLAG_NAME, Rules{}, &of_8);
constinit const KernelTable<double> table =
    detail::make_kernels<LanesOf<32>, double, 32>(JETLAG_NAME, Rules{}, &of_16);
}  // namespace jetlag::JETLAG_INSTRUCTION_SET_NAME
