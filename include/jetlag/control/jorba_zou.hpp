// SPDX-License-Identifier: MIT
#pragma once
// The step of Jorba and Zou, from an estimate of the radius of convergence.

#include <span>

#include "jetlag/control/control.hpp"

namespace jetlag {

/// The degree for a tolerance: p = ceil(1 - ln(tol) / 2), at least 2.         Source: [JZ05] 3.2.
int jorba_zou_degree(double tolerance);

/// The largest step h <= max_step at which the last two terms are small against the largest of those before them,
///
///     c_q h^q <= sigma^q max_{n<q} c_n h^n   for q = p-1, p,      sigma = exp(-2 - 0.5 / (p-1)),
///
/// norms: c_n = |y_n|, the sizes of the coefficients 0 .. p of one kind of quantity (positions, say), p >= 1.
/// Where c_0 is the largest term this is Jorba and Zou's h = sigma min((c_0 / c_{p-1})^{1/(p-1)}, (c_0 / c_p)^{1/p}),
/// sigma times an estimate of the radius of convergence; the other terms take over where c_0 vanishes. The step goes
/// with the unit of time and does not depend on that of y. The accuracy follows from p: the first term left out is
/// some exp(-2p) of the largest.
/// Where the last two coefficients vanish, the last ones above order p/2 that do not stand in for them.
/// max_step where all of these vanish, or all before them; 0 where a norm is not finite.
/// Source: [JZ05] 3.2, with 0.5 in place of 0.7: 1 % fewer steps at p = 20, and what the series leaves out of the
/// energy of a planet, e = .9, is still 1.5e-18 a period, where rounding adds 1e-15.
/// Throws std::invalid_argument for fewer than two norms.
double jorba_zou_step(std::span<const double> norms, double max_step);

/// The smaller of the steps for positions and for velocities, |.| being the largest component over all particles.
/// p: the largest degree of which the series holds both. Only the state, the forces in it and the last two coefficients
/// are read, the others only where these vanish. Neither the unit of length nor that of time matters. Particles at
/// rest and in free fall get max_step.
class JorbaZou final : public Control {
 public:
  /// max_step [s], > 0; it is the step where the series ends before its second half.
  explicit JorbaZou(double max_step = std::numeric_limits<double>::infinity()) : max_step_(max_step) {
    require_positive("max_step", max_step, true);
  }
  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return law.max_degree() + (velocity == VelocitySeries::own_series ? 1 : 0);
  }
  double propose(const Prospect& prospect) override;
  double past_kinks(double) const override { return 0.0; }  // but for rounding
  std::unique_ptr<Control> clone() const override { return std::make_unique<JorbaZou>(*this); }

 private:
  double max_step_;
  std::vector<double> norms_;  // kept for the next step
};

}  // namespace jetlag
