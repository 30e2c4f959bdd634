// SPDX-License-Identifier: MIT
#pragma once
// Lanes of doubles for the instruction set this file is compiled for, and the table of kernels on them.
//
// Included once by each of kernels_sse2.cpp, kernels_avx2.cpp, kernels_avx512.cpp, which define
// JETLAG_INSTRUCTION_SET_NAME and are compiled with that set's flags. Everything here lies in a namespace of
// that name, so that no function compiled for one instruction set can be linked in place of another's.

#include <immintrin.h>

#include <cmath>
#include <numbers>

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
inline constexpr int registers = 4;  // independent sums, enough to hide the latency of an FMA
inline constexpr int block_lanes = 32;

/// `width` doubles with the arithmetic of one.
struct Lane {
  static constexpr int width = register_width * registers;
  Register r[registers];

  Lane() = default;
  explicit Lane(double x) {
    for (auto& v : r) v = broadcast(x);
  }
  static Lane load(const double* from) {
    Lane x;
    for (int i = 0; i < registers; ++i) x.r[i] = JETLAG_INSTRUCTION_SET_NAME::load(from + i * register_width);
    return x;
  }
  static void store(double* to, const Lane& x) {
    for (int i = 0; i < registers; ++i) JETLAG_INSTRUCTION_SET_NAME::store(to + i * register_width, x.r[i]);
  }
};

template <class F>
inline Lane each_register(F f) {
  Lane out;
  for (int i = 0; i < registers; ++i) out.r[i] = f(i);
  return out;
}

inline Lane operator+(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] + b.r[i]; });
}
inline Lane operator-(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] - b.r[i]; });
}
inline Lane operator-(const Lane& a) {
  return each_register([&](int i) { return -a.r[i]; });
}
inline Lane operator*(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] * b.r[i]; });
}
inline Lane operator/(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] / b.r[i]; });
}
inline Lane operator*(double x, const Lane& a) { return Lane(x) * a; }
inline Lane operator-(const Lane& a, double x) { return a - Lane(x); }
inline Lane operator/(const Lane& a, double x) { return a / Lane(x); }
inline Lane sqrt(const Lane& a) {
  return each_register([&](int i) { return root(a.r[i]); });
}

/// f lane by lane, for the functions that the instruction set lacks; they are needed at order 0 only.
[[gnu::noinline]] inline Lane each_lane(const Lane& a, double (*f)(double)) {
  alignas(64) double x[Lane::width];
  Lane::store(x, a);
  for (double& v : x) v = f(v);
  return Lane::load(x);
}
[[gnu::noinline]] inline Lane each_lane(const Lane& a, const Lane& b, double (*f)(double, double)) {
  alignas(64) double x[Lane::width], y[Lane::width];
  Lane::store(x, a);
  Lane::store(y, b);
  for (int i = 0; i < Lane::width; ++i) x[i] = f(x[i], y[i]);
  return Lane::load(x);
}
inline Lane cbrt(const Lane& a) { return each_lane(a, ::cbrt); }
inline Lane exp(const Lane& a) { return each_lane(a, ::exp); }
inline Lane expm1(const Lane& a) { return each_lane(a, ::expm1); }
inline Lane log(const Lane& a) { return each_lane(a, ::log); }
inline Lane log1p(const Lane& a) { return each_lane(a, ::log1p); }
inline Lane log2(const Lane& a) { return each_lane(a, ::log2); }
inline Lane log10(const Lane& a) { return each_lane(a, ::log10); }
inline Lane sin(const Lane& a) { return each_lane(a, ::sin); }
inline Lane cos(const Lane& a) { return each_lane(a, ::cos); }
inline Lane tan(const Lane& a) { return each_lane(a, ::tan); }
inline Lane asin(const Lane& a) { return each_lane(a, ::asin); }
inline Lane acos(const Lane& a) { return each_lane(a, ::acos); }
inline Lane atan(const Lane& a) { return each_lane(a, ::atan); }
inline Lane sinh(const Lane& a) { return each_lane(a, ::sinh); }
inline Lane cosh(const Lane& a) { return each_lane(a, ::cosh); }
inline Lane tanh(const Lane& a) { return each_lane(a, ::tanh); }
inline Lane asinh(const Lane& a) { return each_lane(a, ::asinh); }
inline Lane acosh(const Lane& a) { return each_lane(a, ::acosh); }
inline Lane atanh(const Lane& a) { return each_lane(a, ::atanh); }
inline Lane erf(const Lane& a) { return each_lane(a, ::erf); }
inline Lane erfc(const Lane& a) { return each_lane(a, ::erfc); }
inline Lane exp_of_minus_square(const Lane& a) {
  return each_lane(a, [](double x) { return jetlag::exp_of_minus_square(x); });
}
inline Lane pow(const Lane& a, const Lane& b) { return each_lane(a, b, ::pow); }
inline Lane hypot(const Lane& a, const Lane& b) { return each_lane(a, b, ::hypot); }
inline Lane atan2(const Lane& a, const Lane& b) { return each_lane(a, b, ::atan2); }

// Choices (series/conditions.hpp, series/sign.hpp): each lane by its own number.
inline Lane less(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] < b.r[i] ? broadcast(1) : broadcast(0); });
}
inline Lane less_or_equal(const Lane& a, const Lane& b) {
  return each_register([&](int i) { return a.r[i] <= b.r[i] ? broadcast(1) : broadcast(0); });
}
inline Lane where(const Lane& c, const Lane& a, const Lane& b) {
  return each_register([&](int i) { return c.r[i] == broadcast(0) ? b.r[i] : a.r[i]; });
}
inline Lane sign_of(const Lane& x) {  // NaN, which is neither above nor below nor at 0, stays what it is
  return each_register([&](int i) {
    const Register zero = broadcast(0), not_above = x.r[i] < zero ? broadcast(-1) : x.r[i];
    return x.r[i] > zero ? broadcast(1) : not_above + zero;
  });
}
inline Lane by_sign(const Lane& s, const Lane& a, const Lane& b) {
  return each_register([&](int i) {
    const Register not_above = s.r[i] <= broadcast(0) ? a.r[i] : s.r[i];
    return s.r[i] > broadcast(0) ? b.r[i] : not_above;
  });
}

extern const KernelTable<double> table;

}  // namespace jetlag::JETLAG_INSTRUCTION_SET_NAME

namespace jetlag {
/// a b + c in one rounding where the instruction set has it.
template <>
inline JETLAG_INSTRUCTION_SET_NAME::Lane multiply_add(const JETLAG_INSTRUCTION_SET_NAME::Lane& a,
                                                      const JETLAG_INSTRUCTION_SET_NAME::Lane& b,
                                                      const JETLAG_INSTRUCTION_SET_NAME::Lane& c) {
  using namespace JETLAG_INSTRUCTION_SET_NAME;
  return each_register([&](int i) { return fused(a.r[i], b.r[i], c.r[i]); });
}

template <>
struct Constants<JETLAG_INSTRUCTION_SET_NAME::Lane> {
  using Lane = JETLAG_INSTRUCTION_SET_NAME::Lane;
  static Lane log2_e() { return Lane(std::numbers::log2e); }
  static Lane log10_e() { return Lane(std::numbers::log10e); }
  static Lane two_over_sqrt_pi() { return Lane(2 * std::numbers::inv_sqrtpi); }
};
}  // namespace jetlag

namespace jetlag::JETLAG_INSTRUCTION_SET_NAME {
#define JETLAG_STRING_(x) #x
#define JETLAG_STRING(x) JETLAG_STRING_(x)
constinit const KernelTable<double> table =
    detail::make_kernels<Lane, double, block_lanes>(JETLAG_STRING(JETLAG_INSTRUCTION_SET_NAME), Rules{});
}  // namespace jetlag::JETLAG_INSTRUCTION_SET_NAME
