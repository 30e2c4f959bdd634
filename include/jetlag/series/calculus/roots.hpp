// SPDX-License-Identifier: MIT
#pragma once
// Where a polynomial changes sign: all places in an interval, in order, each to the last bit of what the coefficients say,
// at roots of any odd multiplicity: signs are those of real arithmetic. Coefficients that are rounded themselves, by eps,
// leave a root of multiplicity m open by about eps^(1/m): (s - 1)^3 with exact ones is 0 at 1, that of (s - 0.3)^3 may be
// 1e-5 beside 0.3.
//
// Roots are isolated by Descartes' rule of signs on the Bernstein coefficients of the polynomial: their number of sign
// variations is the number of roots in the interval, or larger by an even number. Intervals with more than one
// variation are split (de Casteljau); the others hold one change of sign or none, which the signs at their ends tell.
// Source: Collins, Akritas, SYMSAC 1976; Lane, Riesenfeld, BIT 21 (1981) 112.
//
//   sign_changes(std::vector{0.5, -1.5, 1.0}, 2.0)     {{0.5, false}, {1.0, true}}: (s - 1/2)(s - 1)

#include <limits>
#include <span>
#include <vector>

namespace jetlag {

struct SignChange {
  double s;     // the first double at which the polynomial no longer has the sign it had before
  bool rising;  // from negative to positive
  friend bool operator==(const SignChange&, const SignChange&) = default;
};

/// What rounding may make of c(s) in double, and of coefficients that are rounded themselves:
///     4 (N+1) eps sum_k |c_k| |s|^k,   eps = 2^-52.
double rounding_of(std::span<const double> c, double s);

/// c(s) as if computed with twice the digits and rounded: Horner's rule with its rounding errors added.
/// Source: Graillat, Langlois, Louvet, JJIAM 26 (2009): |result - c(s)| <= eps/2 |c(s)| + (N eps)^2 sum_k |c_k| |s|^k.
double accurate_value(std::span<const double> c, double s);

/// All changes of sign of c(s) = sum_k c_k s^k in (0, h], in order.
/// A root at 0 is left, not crossed: it is not reported. A root of even multiplicity is no change of sign. A pair of
/// roots is reported when the polynomial between them is larger than its rounding, 4(N+1) eps sum_k |c_k| s^k at the
/// right end: shallower dips cannot be told from a touch, and of three roots as close as that one is reported. A change
/// of sign over the interval is never lost.   Range: no underflow; else a root of multiplicity 3 or more may be off.
/// Throws std::invalid_argument for coefficients that are not finite, for a polynomial that overflows in the interval,
/// and unless h > 0 and finite.
std::vector<SignChange> sign_changes(std::span<const double> c, double h);

}  // namespace jetlag
