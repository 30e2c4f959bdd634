// SPDX-License-Identifier: MIT
#pragma once
// Step control: how far to go, from the series of the motion at the beginning of the step.
//
// Coefficients rescale under h -> a h as c_n h^n -> a^n c_n h^n, so a control can solve for the step before it is
// taken: none is rejected but where the forces at its end are not those of the series (integrators/step_check.hpp).
// Invariants, tested for every member that is not `fixed`:
//   - time t -> lambda t gives h -> h / lambda;
//   - h does not grow as the tolerance shrinks;
//   - a series that ends (free fall, rest) gives the largest step allowed, never infinity or NaN.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "jetlag/base/courant_frequency.hpp"
#include "jetlag/base/step_length.hpp"
#include "jetlag/motion/coefficient_view.hpp"
#include "jetlag/truncation/truncation.hpp"
#include "jetlag/truncation/velocity_series.hpp"

namespace jetlag {

/// What a control looks at.
struct Prospect {
  const Expansion<double>& series;  // known to the order that the control asks for, at least;
                                    // its unit of time is its own: coefficient k comes with time_unit^k
  const TruncationLaw& law;         // where the series will be stopped

  /// What is left to go [s], > 0.
  double limit = std::numeric_limits<double>::infinity();
};

class Control {
 public:
  virtual ~Control() = default;

  /// The highest order of the positions that propose() reads, 0 for none: it is grown before the step is known. It does
  /// not depend on the degree that is drawn, nor may the step, or the series would no longer be unbiased.
  virtual int orders_read(const TruncationLaw& law, VelocitySeries velocity) const = 0;

  /// The next step [s], > 0 and at most max_step. It may be longer than the limit: `cropped`.
  virtual double propose(const Prospect& prospect) = 0;

  /// The longest step that it proposes [s], where that does not depend on the series.
  virtual double longest() const { return std::numeric_limits<double>::infinity(); }

  /// Whether its steps are given, not chosen: then nothing shortens them but the limit.
  virtual bool is_given() const { return false; }

  /// How far [m] beyond a kink of a force (control/to_kinks.hpp) a step that is chosen may end; as far as rounding hides
  /// it, all may.
  virtual double past_kinks() const = 0;

  /// What its Courant limit stands on, if it has one.
  virtual std::optional<CourantFrequency> courant_frequency() const { return std::nullopt; }

  /// A control of the same kind and state.
  virtual std::unique_ptr<Control> clone() const = 0;
};

/// The highest order r that the two estimates below read: N where the degree is fixed; otherwise m + 1, the order of the
/// first random term, which velocities of their own series need at every step anyway, but 4 at least (and N at most): a
/// series has ended where two coefficients in a row vanish, and the second one of free fall does not.
///
/// So the choice of a step does not make the rare high orders be computed. They are continued from those that are read,
///     |c_{r+i}| ~ max(|c_r|, q |c_{r-1}|) q^i,      q = q_r,  or q_{r-1} where |c_r| < q_{r-1} |c_{r-1}| / 2,
///     q_k = (|c_k| / |c_{k-2}|)^{1/2},
/// |.| the largest component over all particles: exact for a geometric series, too large for one that decays faster, and
/// not misled by an order that vanishes at some phase of an oscillation.
int orders_for_errors(const TruncationLaw& law);

/// The largest variance of a component of a position at step h, over all particles: max_i Var g_i(h) [m^2].
double largest_position_variance(const Prospect& prospect, double h);

/// An estimate of what is left out at step h: max(|c_N| h^N, |c_{N-1}| h^{N-1}) over all positions [m]; two terms,
/// because one may vanish by symmetry.
double largest_position_bias(const Prospect& prospect, double h);

/// Throws std::invalid_argument unless x > 0 (and finite, or infinite where that is allowed).
void require_positive(const char* what, double x, bool may_be_infinite = false);

}  // namespace jetlag
