// SPDX-License-Identifier: MIT
#pragma once
// What an ensemble computes lane by lane besides its tape. Compiled once for each instruction set, like the kernels of
// the tape (tape/lanes.hpp), and chosen with them.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace jetlag {

struct EnsembleLanes {
  /// to = factor from.
  void (*scale)(int lanes, double factor, const double* from, double* to);
  /// to_0 = factor_0 from_0,   to_1 = factor_1 from_1,   to_1 following to_0.
  void (*scale_two)(int lanes, double factor_0, double factor_1, const double* from_0, const double* from_1,
                    double* to);
  /// least = min(least, x),   most = max(most, x).
  void (*extend)(int lanes, const double* x, double* least, double* most);
  /// least = min(least, x).
  void (*smaller)(int lanes, const double* x, double* least);
  /// by = factor by.
  void (*multiply)(int lanes, double factor, double* by);
  /// most = max(most, |from|);   not_finite += 0 from, NaN where a number was not finite.
  void (*largest)(int lanes, const double* from, double* most, double* not_finite);
  /// sum_{n=0..last} x_n h^n,   sum_{n=0..last} (n+1) x_{n+1} h^n   and   sum_{n=2..last} n (n-1) x_n h^(n-2),   x_n at the
  /// distance lanes.
  void (*horner)(int lanes, int last, const double* x, const double* h, double* position, double* velocity,
                 double* acceleration);
  /// most = max(most, |2 x - y|);   not_finite as for `largest`.
  void (*depart)(int lanes, const double* x, const double* y, double* most, double* not_finite);
  /// sum_{n=0..last} w_n x_n h^n   and, `of_velocity`,   sum_{n=0..last} (n+1) w_n x_{n+1} h^n;   w_n and x_n at the
  /// distance lanes. A term of weight 0 is left out, finite or not.
  void (*weighted)(int lanes, bool of_velocity, int last, const double* x, const double* w, double h,
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

#if defined(__AVX512F__)
#define JETLAG_PACK 64
#elif defined(__AVX2__)
#define JETLAG_PACK 32
#else
#define JETLAG_PACK 16
#endif

inline void scale(int lanes, double factor, const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < lanes; ++i) to[i] = factor * from[i];
}

inline void scale_two(int lanes, double factor_0, double factor_1, const double* __restrict from_0,
                      const double* __restrict from_1, double* __restrict to) {
  for (int i = 0; i < lanes; ++i) to[i] = factor_0 * from_0[i];
  for (int i = 0; i < lanes; ++i) to[lanes + i] = factor_1 * from_1[i];
}

inline void extend(int lanes, const double* __restrict x, double* __restrict least, double* __restrict most) {
  for (int i = 0; i < lanes; ++i) {
    least[i] = x[i] < least[i] ? x[i] : least[i];
    most[i] = most[i] < x[i] ? x[i] : most[i];
  }
}

inline void smaller(int lanes, const double* __restrict x, double* __restrict least) {
  for (int i = 0; i < lanes; ++i) least[i] = x[i] < least[i] ? x[i] : least[i];
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

/// n packs at a time, enough chains of additions to hide their latency.
template <class Pack, int n>
void horner_of(int last, int stride, const double* x, const double* h, double* position, double* velocity,
               double* acceleration) {
  Pack step[n], p[n], v[n], a[n];
  const auto load = [](const double* from) {
    Pack pack;
    __builtin_memcpy(&pack, from, sizeof(Pack));
    return pack;
  };
  constexpr int width = sizeof(Pack) / sizeof(double);
  for (int i = 0; i < n; ++i) {
    step[i] = load(h + i * width);
    p[i] = load(x + last * stride + i * width);
    v[i] = (last + 1.0) * load(x + (last + 1) * stride + i * width);
    a[i] = Pack{};
  }
  double rank = last;
  Pack newest[n];
  for (int i = 0; i < n; ++i) newest[i] = p[i];
  for (int k = last - 1; k >= 0; --k, rank -= 1.0)
    for (int i = 0; i < n; ++i) {
      if (k > 0) a[i] = a[i] * step[i] + (rank * (rank - 1.0)) * newest[i];
      v[i] = v[i] * step[i] + rank * newest[i];
      newest[i] = load(x + k * stride + i * width);
      p[i] = p[i] * step[i] + newest[i];
    }
  for (int i = 0; i < n; ++i) {
    __builtin_memcpy(position + i * width, &p[i], sizeof(Pack));
    __builtin_memcpy(velocity + i * width, &v[i], sizeof(Pack));
    __builtin_memcpy(acceleration + i * width, &a[i], sizeof(Pack));
  }
}

inline void horner(int lanes, int last, const double* x, const double* h, double* position, double* velocity,
                   double* acceleration) {
  typedef double Pack __attribute__((vector_size(JETLAG_PACK)));
  const auto each = [&]<class P, int n>(std::integral_constant<int, n>, P) {
    constexpr int width = n * static_cast<int>(sizeof(P) / sizeof(double));
    for (int i = 0; i < lanes; i += width)
      horner_of<P, n>(last, lanes, x + i, h + i, position + i, velocity + i, acceleration + i);
  };
  constexpr int of_eight = 64 / JETLAG_PACK;
  if (lanes % (4 * JETLAG_PACK / 8) == 0)
    each(std::integral_constant<int, 4>(), Pack());
  else if (lanes % 16 == 0)
    each(std::integral_constant<int, 2 * of_eight>(), Pack());
  else if (lanes % 8 == 0)
    each(std::integral_constant<int, of_eight>(), Pack());
  else
    each(std::integral_constant<int, 1>(), 0.0);
}

inline void depart(int lanes, const double* __restrict x, const double* __restrict y, double* __restrict most,
                   double* __restrict not_finite) {
  for (int i = 0; i < lanes; ++i) {
    const double size = __builtin_fabs(2.0 * x[i] - y[i]);
    most[i] = most[i] < size ? size : most[i];
    not_finite[i] += 0.0 * size;
  }
}

template <class Pack>
void weighted_of(bool of_velocity, int last, int stride, const double* x, const double* w, double h,
                 double* to) {
  const auto load = [](const double* from) {
    Pack pack;
    __builtin_memcpy(&pack, from, sizeof(Pack));
    return pack;
  };
  const Pack none{};
  Pack sum{};
  for (int n = last; n >= 0; --n) {
    const Pack weight = load(w + n * stride), c = load(x + (n + of_velocity) * stride);
    const double rank = of_velocity ? n + 1.0 : 1.0;
    const Pack term = weight != none ? (weight * rank) * c : none;
    sum = sum * h + term;
  }
  __builtin_memcpy(to, &sum, sizeof(Pack));
}

inline void weighted(int lanes, bool of_velocity, int last, const double* x, const double* w, double h,
                     double* sum) {
  typedef double Pack __attribute__((vector_size(JETLAG_PACK)));
  constexpr int width = JETLAG_PACK / 8;
  if (lanes % width == 0)
    for (int i = 0; i < lanes; i += width)
      weighted_of<Pack>(of_velocity, last, lanes, x + i, w + i, h, sum + i);
  else
    for (int i = 0; i < lanes; ++i) weighted_of<double>(of_velocity, last, lanes, x + i, w + i, h, sum + i);
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

const EnsembleLanes ensemble{&scale,  &scale_two, &extend,   &smaller, &multiply, &largest,
                             &horner, &depart,    &weighted, &log2,    &bound};

}  // namespace JETLAG_INSTRUCTION_SET_NAME
#endif

}  // namespace jetlag
