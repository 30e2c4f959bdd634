// SPDX-License-Identifier: MIT
#pragma once
// What an ensemble computes lane by lane besides its tape. Compiled once for each instruction set, like the kernels of
// the tape (tape/lanes.hpp), and chosen with them.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace jetlag {

struct EnsembleLanes {
  /// to = factor from.
  void (*scale)(int lanes, double factor, const double* from, double* to);
  /// by = factor by.
  void (*multiply)(int lanes, double factor, double* by);
  /// most = max(most, |from|);   not_finite += 0 from, NaN where a number was not finite.
  void (*largest)(int lanes, const double* from, double* most, double* not_finite);
  /// sum_{n=0..last} weight[n] series[n] h^n, series[n] at the distance lanes.
  void (*horner)(int lanes, int last, const double* weight, const double* series, const double* h,
                 double* sum);
  /// log2 of normal numbers > 0, to 1e-12.
  void (*log2)(int lanes, const double* x, double* log);
  /// best = max(best, (a - b + c) d).
  void (*bound)(int lanes, const double* a, const double* b, double c, double d, double* best);
};

/// The functions for an instruction set of available_kernels().
const EnsembleLanes& ensemble_lanes(const char* instruction_set);

#if defined(JETLAG_INSTRUCTION_SET_NAME)
namespace JETLAG_INSTRUCTION_SET_NAME {

extern const EnsembleLanes ensemble;

inline double multiply_add_of(double a, double b, double c) {
#if defined(__FMA__)
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}

inline void scale(int lanes, double factor, const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < lanes; ++i) to[i] = factor * from[i];
}

inline void multiply(int lanes, double factor, double* by) {
  for (int i = 0; i < lanes; ++i) by[i] *= factor;
}

inline void largest(int lanes, const double* __restrict from, double* __restrict most,
                    double* __restrict not_finite) {
  for (int i = 0; i < lanes; ++i) {
    const double size = __builtin_fabs(from[i]);
    most[i] = most[i] < size ? size : most[i];
    not_finite[i] += 0.0 * size;
  }
}

template <int n>
void horner_of(int last, int stride, const double* weight, const double* __restrict series,
               const double* __restrict h, double* __restrict to) {
  double sum[n], step[n];
  for (int i = 0; i < n; ++i) {
    step[i] = h[i];
    sum[i] = weight[last] * series[last * stride + i];
  }
  for (int k = last - 1; k >= 0; --k)
    for (int i = 0; i < n; ++i) sum[i] = multiply_add_of(sum[i], step[i], weight[k] * series[k * stride + i]);
  for (int i = 0; i < n; ++i) to[i] = sum[i];
}

inline void horner(int lanes, int last, const double* weight, const double* series, const double* h,
                   double* sum) {
  if (lanes % 16 == 0)
    for (int i = 0; i < lanes; i += 16) horner_of<16>(last, lanes, weight, series + i, h + i, sum + i);
  else
    for (int i = 0; i < lanes; ++i) horner_of<1>(last, lanes, weight, series + i, h + i, sum + i);
}

/// log2(2^e m) = e + 1/2 + 2/ln 2 artanh t,   t = (m - sqrt 2) / (m + sqrt 2),   1 <= m < 2;   |t| < 0.172, so that
/// the first term left out of artanh is below 1e-12.
inline void log2(int lanes, const double* __restrict x, double* __restrict log) {
  constexpr double root = 1.4142135623730951, two_over_ln2 = 2.885390081777927;
  for (int i = 0; i < lanes; ++i) {
    std::uint64_t bits;
    __builtin_memcpy(&bits, &x[i], 8);
    const std::uint64_t exponent_bits = (bits >> 52) | 0x4330000000000000u,  // 2^52 + biased exponent
        mantissa_bits = (bits & 0x000fffffffffffffu) | 0x3ff0000000000000u;
    double exponent, m;
    __builtin_memcpy(&exponent, &exponent_bits, 8);
    __builtin_memcpy(&m, &mantissa_bits, 8);
    const double t = (m - root) / (m + root), s = t * t;
    const double sum =
        1 + s * (1.0 / 3 + s * (1.0 / 5 + s * (1.0 / 7 + s * (1.0 / 9 + s * (1.0 / 11 + s * (1.0 / 13))))));
    log[i] = (exponent - (4503599627370496.0 + 1023.0)) + (0.5 + two_over_ln2 * t * sum);
  }
}

inline void bound(int lanes, const double* __restrict a, const double* __restrict b, double c, double d,
                  double* __restrict best) {
  for (int i = 0; i < lanes; ++i) {
    const double x = (a[i] - b[i] + c) * d;
    best[i] = best[i] < x ? x : best[i];
  }
}

const EnsembleLanes ensemble{&scale, &multiply, &largest, &horner, &log2, &bound};

}  // namespace JETLAG_INSTRUCTION_SET_NAME
#endif

}  // namespace jetlag
