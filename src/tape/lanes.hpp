// SPDX-License-Identifier: MIT
#pragma once
// Lanes of doubles for the instruction set this file is compiled for, and the table of kernels on them.
//
// Included once by each of kernels_sse2.cpp, kernels_avx2.cpp, kernels_avx512.cpp, which define
// JETLAG_INSTRUCTION_SET_NAME and are compiled with that set's flags. Everything here lies in a namespace of
// that name, so that no function compiled for one instruction set can be linked in place of another's.

#include <immintrin.h>

#include <cmath>

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
template <class F>
inline Lane each_lane(const Lane& a, F f) {
  alignas(64) double x[Lane::width];
  Lane::store(x, a);
  for (double& v : x) v = f(v);
  return Lane::load(x);
}
inline Lane exp(const Lane& a) {
  return each_lane(a, [](double x) { return ::exp(x); });
}
inline Lane log(const Lane& a) {
  return each_lane(a, [](double x) { return ::log(x); });
}
inline Lane sin(const Lane& a) {
  return each_lane(a, [](double x) { return ::sin(x); });
}
inline Lane cos(const Lane& a) {
  return each_lane(a, [](double x) { return ::cos(x); });
}
inline Lane pow(const Lane& a, const Lane& b) {
  alignas(64) double x[Lane::width], y[Lane::width];
  Lane::store(x, a);
  Lane::store(y, b);
  for (int i = 0; i < Lane::width; ++i) x[i] = ::pow(x[i], y[i]);
  return Lane::load(x);
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
}  // namespace jetlag

namespace jetlag::JETLAG_INSTRUCTION_SET_NAME {
#define JETLAG_STRING_(x) #x
#define JETLAG_STRING(x) JETLAG_STRING_(x)
constinit const KernelTable<double> table =
    detail::make_kernels<Lane, double, block_lanes>(JETLAG_STRING(JETLAG_INSTRUCTION_SET_NAME), Rules{});
}  // namespace jetlag::JETLAG_INSTRUCTION_SET_NAME
