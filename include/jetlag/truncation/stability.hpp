// SPDX-License-Identifier: MIT
#pragma once
// Stability of series stopped at a random degree: what one step does to linear motions.
//
// For y' = lambda y and z = lambda h a step multiplies y by
//
//     R_K(z) = sum_{n<=K} w_n z^n / n!,      E R_K = T_N(z) = sum_{n<=N} z^n / n!,
//     E|R_K|^2 = |T_N(z)|^2 + sum_{m<n<=N} (w_n - w_{n-1}) |S_n(z)|^2,      S_n(z) = sum_{j=n..N} z^j / j!,
//
// and there are three things that may be asked not to grow: the mean, the mean square, and a single run, which
// almost surely grows as |R_{K_1} R_{K_2} ...|^(1/steps) -> exp E log|R_K|. The mean square asks for most:
//
//     E log|R_K|  <=  log sqrt E|R_K|^2,      log|T_N|  <=  log sqrt E|R_K|^2.
//
// The factors of different K commute, so only how often each K occurs counts: E log|R_K| is also exactly the growth of a
// linear motion under equidistributed draws of K (ruler, rotation), whatever their order.

#include <complex>

#include "jetlag/truncation/truncation.hpp"
#include "jetlag/truncation/velocity_series.hpp"

namespace jetlag {

enum class Growth {
  of_mean,      // log|T_N|: what the mean of many runs does; a fixed degree N does nothing else
  mean_square,  // log sqrt E|R_K|^2
  almost_sure,  // E log|R_K|
};

/// The growth in one step [1], a logarithm; stable where it is <= 0. Accurate in its own digits where it is small, not
/// merely in those of 1 + growth; -infinity where R_K(z) = 0 may happen (almost_sure, of_mean).
double growth(const TruncationLaw& law, Growth of, std::complex<double> z);

/// The oscillator  q'' = -frequency^2 q - damping q'.   frequency [rad/s] and damping [1/s], >= 0, not both 0.
struct Oscillator {
  double frequency, damping;
};

/// The same for a step h [s] of an oscillator, in the norm of its energy. With `own_series` each of its two eigenvalues is
/// a lambda as above and the one that grows more counts. With `derivative` a step is
///     (q, v) <- R (q, v),   R = row of q of  sum_{n<=K} w_n (hA)^n / n!,   row of v of  sum_{n<K} w_{n+1} (hA)^n / n!,
/// and the mean square grows with the spectral radius of P -> E[R P R^T] on symmetric matrices.
/// Throws std::invalid_argument for almost_sure with `derivative`: matrices of different K do not commute.
double growth(const TruncationLaw& law, Growth of, VelocitySeries velocity, const Oscillator& oscillator,
              double h);

/// The largest r such that all z = s direction / |direction|, 0 < s <= r, are stable: the first exit from 0, to the
/// rounding of double. Found by strides, of 1/256 where none is given: 0 where it is shorter than one; an exit and return
/// within one is not seen. direction: not 0 and not to the right of the imaginary axis. Throws std::invalid_argument.
double stability_limit(const TruncationLaw& law, Growth of, std::complex<double> direction,
                       double stride = 0x1p-8);

/// The largest step [s] of that kind for an oscillator; strides of 1/256 of its faster time, 1 / max(frequency, damping).
double stability_limit(const TruncationLaw& law, Growth of, VelocitySeries velocity,
                       const Oscillator& oscillator);

/// The largest step [s] at which all oscillators of frequencies up to that of `fastest` and of this damping are stable in
/// mean square. Slow ones count: what damping takes from them each step is less than what degree 6, say, gives.
/// Found by strides of max(1, N/8) / 32 of the fastest time, over 128 frequencies.
double band_stability_limit(const TruncationLaw& law, VelocitySeries velocity, const Oscillator& fastest);

}  // namespace jetlag
