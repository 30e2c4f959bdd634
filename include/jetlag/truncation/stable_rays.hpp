// SPDX-License-Identifier: MIT
#pragma once
// Steps that are stable for all modes of a body whose stiffness and whose damping are bounded, each by one number.
//
// Let M x'' + C x' + K x = 0 with symmetric C and K, and for all u with u^H M u = 1
//
//     0 <= u^H K u <= omega^2,     g <= u^H C u <= G.
//
// Each eigenvalue lambda of the motion has a u with (lambda^2 M + lambda C + K) u = 0. Times u^H it says that lambda is one
// of an oscillator whose squared frequency and damping lie in this rectangle, also where no modes are common to C and K:
//
//     |lambda| <= omega, -G/2 <= Re lambda <= -g/2,     or  lambda real,  -G <= lambda <= 0.
//
// With velocities of their own series a step is a polynomial of the matrix of the motion, and multiplies the mode of lambda
// by R_K(h lambda): stable where all these h lambda are (stability.hpp). As h grows, h lambda moves along a ray from 0. So
// the largest step is the least, over all rays at an angle a from the imaginary axis, of the first exit r along the ray over
// the largest |lambda| on it,
//
//     h = min( min r(a) / min(omega, G / (2 sin a)),  r(pi/2) / G ),     sin a = -Re lambda / |lambda| >= g / (2 omega).
//
// Where C is proportional to K, modes that are damped much are fast ones, which the rectangle does not know: the true limit
// may be twice as long (measured where it is tested).
// Source: F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43, 2001.

#include <utility>
#include <vector>

#include "jetlag/truncation/truncation.hpp"

namespace jetlag {

/// The rectangle.
struct ModeBounds {
  double frequency;                    // omega [rad/s], >= 0
  double least_damping, most_damping;  // g <= G [1/s], >= 0
};

/// First exits of a law, in mean square, along 65 rays from the imaginary to the negative real axis, and where these have a
/// least one between them, along that; by strides of 1/64. Of all rays between two neighbours the lesser of both exits counts: exits that are
/// less on a width of 1.4 degrees than at its ends and in the middle of it are not seen.
class StableRays {
 public:
  explicit StableRays(const TruncationLaw& law);

  /// The largest step [s], 0 if none is stable, infinity for bounds of zero.
  double step(const ModeBounds& bounds) const;

 private:
  struct Ray {
    double angle, exit;  // from the imaginary axis [rad]; r
  };
  double exit(double angle) const;
  Ray least_between(double low, double high) const;

  TruncationLaw law_;
  std::vector<Ray> rays_;  // by angle, from 0 to pi/2
};

}  // namespace jetlag
